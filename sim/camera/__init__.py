"""Simulate a colour-and-depth camera in the home. Imports sim.site and wire.

``Renderer`` draws clean pictures with the name of what every pixel shows, ``spoil`` makes them look
taken, ``Appearance`` is all that may vary between homes that hold the same things.
``SimCamera`` is the camera itself: scenes in, packed pictures out, with its faults.
"""

from sim.camera.camera import SimCamera
from sim.camera.camera_faults import PicturePair
from sim.camera.frame import Frame
from sim.camera.noise import spoil
from sim.camera.renderer import Renderer
from sim.camera.surfaces import Appearance, Texture
from sim.camera.view import focal_px

__all__ = [
    "Appearance",
    "Frame",
    "PicturePair",
    "Renderer",
    "SimCamera",
    "Texture",
    "focal_px",
    "spoil",
]
