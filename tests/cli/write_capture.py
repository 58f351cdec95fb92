# Writes a frame in Lamplight's capture format. Needs NumPy alone.
# SPDX-License-Identifier: Apache-2.0
import json
import struct

import numpy as np


def write_exr(file, channels):
    """32-bit floats, not compressed; `channels` maps a name to an array (height, width)."""
    def attribute(name, kind, value):
        return f"{name}\0{kind}\0".encode() + struct.pack("<i", len(value)) + value

    names = sorted(channels)
    height, width = channels[names[0]].shape
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    one = struct.pack("<f", 1.0)
    channel_list = b"".join(name.encode() + struct.pack("<x4i", 2, 0, 1, 1) for name in names) + b"\0"
    header = (struct.pack("<2i", 20000630, 2) + attribute("channels", "chlist", channel_list)
              + attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", box)
              + attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", b"\0")
              + attribute("pixelAspectRatio", "float", one) + attribute("screenWindowCenter", "v2f", bytes(8))
              + attribute("screenWindowWidth", "float", one) + b"\0")
    line = 4 * width * len(names)
    with open(file, "wb") as out:
        out.write(header)
        out.write((len(header) + 8 * height + (8 + line) * np.arange(height)).astype("<u8").tobytes())
        for y in range(height):
            out.write(struct.pack("<2i", y, line))
            out.write(np.stack([channels[name][y] for name in names]).astype("<f4").tobytes())


def write_capture(folder, depth, depth_kind, clip_from_view, view_from_world, lights):
    """`depth`: (height, width). `lights`: (N, 16). Matrices are used as `matrix @ column`."""
    folder.mkdir(parents=True)
    write_exr(folder / "depth.exr", {"Z": depth})
    np.save(folder / "lights.npy", np.ascontiguousarray(lights, dtype="<f4"))
    height, width = depth.shape
    frame = {"version": 1, "width": width, "height": height,
             "clip_from_view": clip_from_view.T.ravel().tolist(),  # column after column
             "view_from_world": view_from_world.T.ravel().tolist(),
             "depth": "depth.exr", "depth_kind": depth_kind, "lights": "lights.npy"}
    (folder / "frame.json").write_text(json.dumps(frame))
