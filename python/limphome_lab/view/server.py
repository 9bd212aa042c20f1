"""A page of viser on the loopback that only who was given its address can open.

Whoever opens the page can steer the robot. Other users of this machine can reach its loopback, and so can, by way of
the browser, pages from elsewhere (DNS rebinding). So each address holds a secret word, and requests must come for the
loopback by name and from the page itself. docs/security.md.
"""

import contextlib
import hmac
import http
import io
import logging
import secrets
import socket
from unittest import mock

import viser
import websockets.asyncio.server

from limphome_lab.ending import InputError

HOST = "127.0.0.1"
NAMES = (HOST, "localhost")
WORD_BYTES = 16  # of the secret
PORT_MAX = 65535


class Page(viser.ViserServer):
    """`port` 0: a free one. `url` is what the person opens."""

    def __init__(self, label, port=0):
        _check(port)
        # a browser opens connections that it does not use, which is no news
        logging.getLogger("websockets.server").setLevel(logging.CRITICAL)
        self.word = secrets.token_urlsafe(WORD_BYTES)
        guarded = _Guarded(websockets.asyncio.server.serve, self.word)
        # viser has no way to hand a check in; it starts its server by this function
        with mock.patch("websockets.asyncio.server.serve", guarded), _silently():
            super().__init__(host=HOST, port=port, label=label, verbose=False)
        if not guarded.used:
            self.stop()
            raise RuntimeError("this version of viser starts its server in another way: nothing would guard the page")
        self.url = f"http://{HOST}:{self.get_port()}/{self.word}/"

    def request_share_url(self, verbose=True):
        """Never: the page stays on this machine."""

    def stop(self):
        with _silently():
            super().stop()


class _Guarded:
    """websockets' `serve` with a check of each request before any other."""

    def __init__(self, serve, word):
        self._serve, self._word = serve, word
        self.used = False

    def __call__(self, handler, host, port, *, process_request, **options):
        self.used = True

        def admit(connection, request):
            if not self._may_pass(connection, request):
                return connection.respond(http.HTTPStatus.FORBIDDEN, "open the address that limphome printed\n")
            request.path = "/" + request.path.removeprefix(f"/{self._word}").lstrip("/")
            return process_request(connection, request)

        return self._serve(handler, host, port, process_request=admit, **options)

    def _may_pass(self, connection, request):
        port = connection.local_address[1]
        here = [f"{name}:{port}" for name in NAMES]
        hosts, origins = request.headers.get_all("Host"), request.headers.get_all("Origin")
        word = request.path.partition("?")[0].split("/")[1]
        return (
            hmac.compare_digest(word.encode(), self._word.encode())
            and len(hosts) == 1
            and hosts[0] in here
            and all(origin in [f"http://{each}" for each in here] for origin in origins)
        )


def _check(port):
    """viser waits for ever for a server that cannot have its port, and takes the next where one is in use."""
    if not 0 <= port <= PORT_MAX:
        raise InputError(f"--port {port}: must be from 0, a free one, to {PORT_MAX}")
    with socket.socket() as tried:
        tried.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            tried.bind((HOST, port))
        except OSError as error:
            raise InputError(f"--port {port}: {error.strerror}") from error


@contextlib.contextmanager
def _silently():
    """viser prints a banner, and where it ends."""
    with contextlib.redirect_stdout(io.StringIO()):
        yield
