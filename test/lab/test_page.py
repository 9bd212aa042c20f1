"""The page of a viewer opens to who was given its address, and to nobody else."""

import asyncio
import urllib.error
import urllib.request

import pytest
import viser
import websockets.asyncio.client
import websockets.exceptions

from limphome_lab.ending import InputError
from limphome_lab.view.server import HOST, Page


@pytest.fixture(scope="module")
def page():
    page = Page("test")
    yield page
    page.stop()


def status(url, **headers):
    try:
        return urllib.request.urlopen(urllib.request.Request(url, headers=headers)).status
    except urllib.error.HTTPError as error:
        return error.code


def connects(url, origin):
    async def attempt():
        protocol = [f"viser-v{viser.__version__}"]
        try:
            async with websockets.asyncio.client.connect(url, origin=origin, subprotocols=protocol):
                return True
        except websockets.exceptions.InvalidStatus as refused:
            assert refused.response.status_code == 403
            return False

    return asyncio.run(attempt())


def test_listens_on_the_loopback_alone(page):
    assert page.get_host() == HOST == "127.0.0.1"


def test_opens_by_its_address_alone(page):
    bare = f"http://{HOST}:{page.get_port()}"
    assert status(page.url) == 200
    assert status(page.url.replace(HOST, "localhost")) == 200
    for url in (f"{bare}/", f"{bare}/{page.word[:-1]}/", f"{bare}//{page.word}/", f"{bare}/?{page.word}"):
        assert status(url) == 403, url


def test_refuses_other_pages_and_other_names(page):
    assert status(page.url, Host="attacker.example") == 403, "a name that leads here for the moment"
    assert status(page.url, Origin="http://attacker.example") == 403


def test_a_socket_needs_the_address_and_the_origin(page):
    own = f"http://{HOST}:{page.get_port()}"
    socket = page.url.replace("http", "ws")
    assert connects(socket, own)
    assert not connects(socket, "http://attacker.example")
    assert not connects(f"ws://{HOST}:{page.get_port()}/", own)


def test_is_never_shared(page):
    assert page.request_share_url() is None


@pytest.mark.parametrize("port", [-1, 65536])
def test_refuses_what_is_no_port(port):
    with pytest.raises(InputError, match=f"--port {port}: must be from 0"):
        Page("test", port)


def test_refuses_a_port_in_use(page):
    with pytest.raises(InputError, match="in use"):
        Page("test", page.get_port())
