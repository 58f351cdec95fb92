# A renderer of its own: traces a court with NumPy, writes it with write_capture.py, and prints how many pairs of pixel
# and light there are where the light reaches the pixel. Usage: court.py FOLDER reversed|standard|linear
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

import numpy as np
from write_capture import write_capture

WIDTH, HEIGHT, LIGHTS = 160, 90, 200
NEAR, FAR = 0.1, 80.0
RIGHT, TOP = 0.96, 0.54  # of the window, 1 m ahead


def pose(eye, yaw, pitch):
    """view_from_world of a camera that looks down -Z before it is turned."""
    cy, sy, cp, sp = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch)
    turn = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]) @ np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
    world_from_view = np.eye(4)
    world_from_view[:3, :3] = turn
    world_from_view[:3, 3] = eye
    return np.linalg.inv(world_from_view), world_from_view


def trace(origin, rays):
    """How far along each ray the court is: a floor, two walls and a few balls; infinity for sky."""
    nearest = np.full(rays.shape[:2], np.inf)

    def meet(distance):
        np.minimum(nearest, np.where(distance > NEAR, distance, np.inf), out=nearest)

    with np.errstate(divide="ignore", invalid="ignore"):
        meet(-origin[1] / rays[..., 1])
        for axis, place in ((2, -14.0), (0, -9.0)):
            distance = (place - origin[axis]) / rays[..., axis]
            height = origin[1] + distance * rays[..., 1]
            meet(np.where(height < 6.0, distance, np.inf))
        for center, radius in (((0, 1, -4), 1.0), ((-4, 1.5, -8), 1.5), ((3, 2, -9), 2.0), ((1.5, 0.5, -1), 0.5)):
            to_center = np.array(center) - origin
            along = rays @ to_center
            squared = (rays ** 2).sum(-1)
            meet((along - np.sqrt(along ** 2 - squared * (to_center @ to_center - radius ** 2))) / squared)
    return np.where(nearest < FAR, nearest, np.inf)


def make_lights(random):
    lights = np.zeros((LIGHTS, 16))
    lights[:, 0:3] = random.uniform((-8, 0.2, -13), (8, 5, 2), (LIGHTS, 3))
    lights[:, 3] = random.uniform(0.5, 4, LIGHTS)  # range, m
    lights[:, 4:7] = random.uniform(0.2, 1, (LIGHTS, 3))
    lights[:, 7] = lights[:, 3] ** 2  # candela
    lights[:, 8:11] = random.normal(size=(LIGHTS, 3)) - (0, 1, 0)
    lights[:, 12] = random.uniform(0.3, 1.2, LIGHTS)
    lights[:, 11] = 0.7 * lights[:, 12]
    lights[:, 13] = np.arange(LIGHTS) % 2  # every other one a spot
    return lights


def count_reached(places, lights):
    """The definition, in double precision: nearer than the range; for spots also inside the outer cone."""
    reached = 0
    for light in lights:
        away = places - light[0:3]
        distance = np.linalg.norm(away, axis=-1)
        inside = distance < light[3]
        if light[13] == 1:
            axis = light[8:11] / np.linalg.norm(light[8:11])
            inside &= away @ axis >= np.cos(light[12]) * distance
        reached += int(inside.sum())
    return reached


def main(folder, kind):
    eye = np.array([1.0, 2.5, 5.0])
    view_from_world, world_from_view = pose(eye, yaw=0.2, pitch=-0.15)
    x, y = np.meshgrid((np.arange(WIDTH) + 0.5) / WIDTH * 2 - 1, (np.arange(HEIGHT) + 0.5) / HEIGHT * 2 - 1)
    rays = np.stack([x * RIGHT, -y * TOP, -np.ones_like(x)], -1) @ world_from_view[:3, :3].T  # 1 m ahead
    metres = trace(eye, rays)

    clip_from_view = np.zeros((4, 4))
    clip_from_view[0, 0], clip_from_view[1, 1], clip_from_view[3, 2] = 1 / RIGHT, -1 / TOP, -1
    if kind == "reversed":  # infinite far plane
        clip_from_view[2, 3] = NEAR
        depth = NEAR / metres
    else:
        clip_from_view[2, 2:4] = -FAR / (FAR - NEAR), -FAR * NEAR / (FAR - NEAR)
        standard = np.where(np.isinf(metres), 1.0, FAR / (FAR - NEAR) * (1 - NEAR / metres))
        depth = metres if kind == "linear" else standard

    lights = make_lights(np.random.default_rng(4)).astype("f4")
    write_capture(folder, depth, kind, clip_from_view, view_from_world, lights)
    seen = np.isfinite(metres)
    print(count_reached(eye + metres[seen][:, None] * rays[seen], lights.astype("f8")))


main(pathlib.Path(sys.argv[1]), sys.argv[2])
