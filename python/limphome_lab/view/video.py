"""A recorded episode as MP4 or GIF: drawn by the page of scripts/replay in a browser without a window."""

import contextlib
import subprocess
import sys

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from limphome_lab import files
from limphome_lab.ending import Ending, InputError
from limphome_lab.show.share import Share
from limphome_lab.view import angles, stage
from limphome_lab.view.browser import Browser, needed
from limphome_lab.view.recorded_run import lanes
from limphome_lab.view.server import Page

HOLD_S = 1.0  # of the video that its last picture stays
SAMPLE_S = 0.1  # between the moments for which the robot must be in the picture
SMOOTH_S = 1.0  # over which the eye that follows evens out how the robot moves
LINES_REACH = 10.0  # [m] of the ground's lines round the path
CAPTION_HEIGHT = 0.07  # of the picture's
CAPTION_COLOUR = (34, 34, 34)
FORMATS = {  # suffix: (pictures a second, options of ffmpeg)
    ".mp4": (25, ["-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"]),
    ".gif": (
        12.5,  # GIF counts in 1/100 s
        [
            "-filter_complex",
            "split[a][b];[a]palettegen=max_colors=96:stats_mode=full[p];[b][p]paletteuse=dither=none:diff_mode=rectangle",
            *("-loop", "0", "-f", "gif"),
        ],
    ),
}


def check(file):
    """The suffix of a file to be, which tells its format; InputError where it is none."""
    suffix = file.suffix.lower()
    if suffix not in FORMATS:
        raise InputError(f"--video {file}: ends in none of {', '.join(FORMATS)}")
    if not file.parent.is_dir():
        raise InputError(f"--video {file}: there is no folder {file.parent}")
    return suffix


def write(folders, number, file, names, size, speed):
    """Draws episode `number`, None: the last, of each run folder, side by side, into `file`: a picture from each of the
    angles `names`, side by side, each of `size` (width, height); `speed`: the plant's time to the video's."""
    rate, options = FORMATS[check(file)]
    with contextlib.ExitStack() as stack:
        print("opening the page in a browser without a window", file=sys.stderr, flush=True)
        page = Page("limphome")
        stack.callback(page.stop)
        browser = stack.enter_context(Browser(page))
        scene = browser.client.scene
        runs = lanes(scene, folders)
        for run in runs:
            run.take(number)
        prepare(scene, runs)
        times = np.arange(0, max(run.track.duration for run in runs) + speed * HOLD_S, speed / rate)
        eyes = [eyes_of(runs, name, times, size[0] / size[1]) for name in names]
        fresh = stack.enter_context(files.replacing(file))
        encoder = stack.enter_context(Encoder(fresh, (size[0] * len(names), size[1]), rate, options))
        browser.settle(eyes[0][0], *size, angles.FIELD_OF_VIEW)
        share = stack.enter_context(Share("drawing", len(times)))
        for index, time in enumerate(times):
            for run in runs:
                run.show(time)
            views = [(each[index], *size, angles.FIELD_OF_VIEW) for each in eyes]
            encoder.add(captioned(np.hstack([browser.picture(*view) for view in views]), caption(runs, time, speed)))
            share.update(index + 1)
        encoder.finish()


def prepare(scene, runs):
    """Leaves out what would only hide the robot, and makes the ground one that is seen alike from each angle."""
    stage.light(scene)
    for run in runs:
        for layer in ("labels", "centre of mass"):
            run.scene.set_shown(layer, False)
    reach = LINES_REACH + max(np.abs(run.place(run.track.duration)).max() for run in runs)
    stage.put_lines(scene, [run.ground for run in runs], reach)


def eyes_of(runs, name, times, width_to_height):
    """An Eye for each of the times."""
    failed = runs[0].scene.frame.health != 0
    crawlers = runs[0].robot.told["crawlers"]
    mirrored = any(bad and crawler["centre"][1] < 0 for bad, crawler in zip(failed, crawlers, strict=False))
    direction = angles.towards(name, mirrored)
    moments = np.arange(0, times[-1], SAMPLE_S)
    if name != angles.FOLLOWED:
        points = np.vstack([run.corners(time) for run in runs for time in moments])
        return [angles.fitted(direction, points, width_to_height)] * len(times)
    ways = {time: np.mean([run.place(time) for run in runs], axis=0) for time in moments}
    smooth = np.column_stack([smoothed(each, round(SMOOTH_S / SAMPLE_S)) for each in np.transpose(list(ways.values()))])
    around = np.vstack(
        [run.corners(time) - middle for run in runs for time, middle in zip(moments, smooth, strict=True)]
    )
    eye = angles.fitted(direction, around, width_to_height)
    followed = np.column_stack([np.interp(times, moments, each) for each in smooth.T])
    return [angles.Eye(eye.position + way, eye.wxyz) for way in followed]


def smoothed(values, half):
    """Means over up to 2 half + 1 values round each."""
    return [values[max(0, i - half) : i + half + 1].mean() for i in range(len(values))]


def caption(runs, time, speed):
    words = " | ".join(
        f"episode {run.track.number}: {run.track.outcome}"
        if time >= run.track.duration
        else f"episode {run.track.number}"
        for run in runs
    )
    pace = f" (x{speed:g})" if speed != 1 else ""
    return f"{words}   {min(time, max(run.track.duration for run in runs)):.1f} s{pace}"


def captioned(picture, words):
    image = Image.fromarray(picture)
    size = max(12, round(CAPTION_HEIGHT * image.height * 0.7))
    draw = ImageDraw.Draw(image)
    draw.text((size * 0.7, image.height - size * 1.6), words, CAPTION_COLOUR, ImageFont.load_default(size))
    return np.asarray(image)


class Encoder:
    """ffmpeg, which takes picture after picture."""

    def __init__(self, file, size, rate, options):
        width, height = size
        self._command = [
            *(needed("ffmpeg"), "-loglevel", "error", "-y"),
            *("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(rate), "-i", "-"),
            *(*options, str(file)),
        ]

    def __enter__(self):
        # a session of its own: Ctrl-C reaches this process alone
        self._process = subprocess.Popen(
            self._command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True
        )
        return self

    def add(self, picture):
        try:
            self._process.stdin.write(picture.tobytes())
        except BrokenPipeError:
            self._fail()

    def finish(self):
        self._process.stdin.close()
        if self._process.wait() != 0:
            self._fail()

    def _fail(self):
        raise Ending(f"ffmpeg: {self._process.stderr.read().decode(errors='replace').strip()}")

    def __exit__(self, *_):
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        self._process.stderr.close()
