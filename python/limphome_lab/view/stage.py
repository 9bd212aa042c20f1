"""Light, and lines on level ground that any eye sees alike."""

import numpy as np

from limphome_lab.view.ground import LINE

BRIGHTNESS = 0.6  # of the light from all around; little enough that shadows tell what is lifted
LINES_EVERY = 1.0  # [m]
LINE_THICKNESS = 0.012  # [m]
ABOVE_GROUND = 0.001  # [m]


def light(scene):
    scene.configure_environment_map(hdri="city", environment_intensity=BRIGHTNESS)


def put_lines(scene, grounds, reach):
    """Where all is level, a grid round the page's origin, up to `reach` [m] to each side, in place of viser's own: that
    has no end, but fades with the distance from a run's origin, and in a picture by the page's eye, not its own."""
    if not all(ground.level for ground in grounds):
        return
    for ground in grounds:
        ground.hide_grid()
    # in short pieces: long ones that end behind an eye are cut
    at = np.arange(-np.ceil(reach), np.ceil(reach) + 1, LINES_EVERY)
    begin, across = (each.ravel() for each in np.meshgrid(at[:-1], at))
    along = np.stack([np.column_stack([begin, across]), np.column_stack([begin + LINES_EVERY, across])], axis=1)
    both = np.vstack([along, along[..., ::-1]])
    points = np.concatenate([both, np.full((*both.shape[:2], 1), ABOVE_GROUND)], axis=2)
    scene.add_line_segments("/lines", points, LINE, thickness=LINE_THICKNESS)
