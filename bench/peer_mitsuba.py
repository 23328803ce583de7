"""One volume under one sun by Mitsuba 3, single scattering, for `brume bench --peers`: peer_mitsuba.py WORK.json.
Renders twice with other seeds after a small picture that has the kernels compiled; prints the seconds of the second
one."""
import json
import os
import sys
import time

import mitsuba as mi
import numpy as np

with open(sys.argv[1], encoding="utf-8") as file:
    work = json.load(file)
# An LLVM of another age than it was made for ends the process: only one that was named.
mi.set_variant("llvm_ad_rgb" if os.environ.get("DRJIT_LIBLLVM_PATH") else "scalar_rgb")

T = mi.ScalarTransform4f
nx, ny, nz = (int(n) for n in work["size"])
density = np.fromfile(work["densities"], dtype=np.float32).reshape(nz, ny, nx, 1)
lo, hi = np.array(work["lo"]), np.array(work["hi"])
onto_bounds = T().translate(lo.tolist()).scale((hi - lo).tolist())  # of the unit cube
sigma_t = np.array(work["sigma_a"]) + np.array(work["sigma_s"])
medium = {
    "type": "heterogeneous",
    "sigma_t": {"type": "gridvolume", "grid": mi.VolumeGrid(density), "to_world": onto_bounds, "raw": True},
    "scale": float(sigma_t[0]),
    "albedo": {"type": "rgb", "value": (np.array(work["sigma_s"]) / sigma_t).tolist()},
}


def scene(width, height):
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": 2},
        "sensor": {
            "type": "perspective", "fov": work["vfov"], "fov_axis": "y",
            "to_world": T().look_at(origin=work["eye"], target=work["target"], up=work["up"]),
            "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}},
            "sampler": {"type": "independent"},
        },
        "sun": {"type": "directional", "direction": work["direction"],
                "irradiance": {"type": "rgb", "value": work["irradiance"]}},
        "fog": {"type": "cube", "to_world": onto_bounds @ T().translate([0.5, 0.5, 0.5]).scale(0.5),
                "bsdf": {"type": "null"}, "interior": medium},
    })


def render(what, spp, seed):
    begin = time.time()
    picture = np.array(mi.render(what, spp=spp, seed=seed))
    return picture, time.time() - begin


whole = scene(*work["film"])
render(whole, 1, 7)
for seed, out in enumerate(work["pictures"]):
    picture, seconds = render(whole, work["spp"], seed)
    mi.Bitmap(picture[:, :, :3].astype(np.float32)).write(out)
print(mi.variant(), seconds)
