#!/usr/bin/env python3
"""Roughness parameters and readers of `asperity surface` beside two public packages.

Five surfaces, each as four files: .npy and .csv by numpy, .x3p by SurfaceTopography, .sur by surfalize. The program reads every
file; both packages have the heights. Needs: pip install numpy surfalize SurfaceTopography

    python3 tests/peers/surfaces.py [target/release/asperity]

Prints a table of the greatest differences; exit 1 where Sq, Sa, Ssk or Sku differ by more than 0.1 % (Ssk by 0.001 where it is
below 1), another by more than 0.5 %.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
from surfalize import Surface
from SurfaceTopography import Topography

ROWS, COLUMNS, PIXEL_UM = 200, 256, 1.0
# Sdq' is the slope by forward differences, as surfalize has it; Str is open where a way of decay leaves the map.
NAMES = ["Sq", "Sa", "Ssk", "Sku", "Sp", "Sv", "Sz", "Sdq'", "Sal", "Str"]
CLOSE, NEAR = 1e-3, 5e-3


def surfaces():
    """Name and heights in micrometres, rows along y."""
    random = np.random.default_rng(20)
    fx = np.fft.fftfreq(COLUMNS)[None, :]
    fy = np.fft.fftfreq(ROWS)[:, None]

    def made(amplitude):
        noise = np.fft.fft2(random.standard_normal((ROWS, COLUMNS)))
        heights = np.fft.ifft2(noise * amplitude).real
        return heights / heights.std()

    y, x = np.mgrid[0:ROWS, 0:COLUMNS].astype(float)
    isotropic = made(np.exp(-300 * (fx**2 + fy**2)))
    along, across = fx * np.cos(0.5) + fy * np.sin(0.5), fy * np.cos(0.5) - fx * np.sin(0.5)
    ridges = made(np.exp(-200 * along**2 - 9000 * across**2))
    other = made(np.exp(-60 * (fx**2 + fy**2)))
    self_affine = made((fx**2 + fy**2 + 1e-3) ** -0.9)
    return {
        "isotropic": 0.3 * isotropic,
        "ridges": 0.4 * ridges,
        "honed": 0.2 * np.minimum(isotropic, 0.3 + 0.05 * other),
        "peaks": 0.1 * np.exp(0.6 * isotropic),
        "tilted": 0.5 * self_affine + 0.01 * x - 0.004 * y,
    }


def write(folder, name, heights):
    """The four files of a surface and the words with which the program reads each."""
    metres = heights * 1e-6
    size = (COLUMNS * PIXEL_UM, ROWS * PIXEL_UM)
    pixel = ["--pixel-m", f"{PIXEL_UM * 1e-6}"]
    paths = {kind: folder / f"{name}.{kind}" for kind in ("npy", "csv", "x3p", "sur")}
    np.save(paths["npy"], metres)
    np.savetxt(paths["csv"], metres, delimiter=",")
    Topography(heights.T, physical_sizes=size, unit="µm").to_x3p(str(paths["x3p"]))
    Surface(heights, PIXEL_UM, PIXEL_UM).save(str(paths["sur"]))
    return {kind: [str(path)] + (pixel if kind in ("npy", "csv") else []) for kind, path in paths.items()}


def ours(program, words):
    text = subprocess.run([program, "surface", *words], capture_output=True, text=True, check=True).stdout
    found = dict(re.findall(r"^(S\w+'?) +(-?[\d.e-]+)(?: µm)? ", text, re.M))
    return {name: float(found[name]) for name in NAMES if name in found}


def theirs(heights):
    """Of surfalize all; of SurfaceTopography the height and the slope along both axes."""
    surface = Surface(heights, PIXEL_UM, PIXEL_UM).level()
    one = {name: getattr(surface, name.rstrip("'"))() for name in NAMES}
    plane = Topography(heights.T, physical_sizes=(COLUMNS * PIXEL_UM, ROWS * PIXEL_UM)).detrend("height")
    return {"surfalize": one, "SurfaceTopography": {"Sq": plane.rms_height_from_area()}}


def difference(name, found, wanted):
    return abs(found - wanted) / (1.0 if name == "Ssk" and abs(wanted) < 1 else abs(wanted))


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "target/release/asperity"
    worst, compared, misses = {}, 0, []
    with tempfile.TemporaryDirectory() as folder:
        for name, heights in surfaces().items():
            for kind, words in write(pathlib.Path(folder), name, heights).items():
                found = ours(program, words)
                for package, numbers in theirs(heights).items():
                    for what, wanted in numbers.items():
                        if what not in found or not np.isfinite(wanted):
                            continue
                        off = difference(what, found[what], wanted)
                        compared += 1
                        at = (package, what)
                        worst[at] = max(worst.get(at, (0.0, "")), (off, f"{name}.{kind}"))
                        if off > (CLOSE if what in NAMES[:4] else NEAR):
                            misses.append(f"{package} {what} {name}.{kind}: {found[what]} beside {wanted:.6g}")
    print(f"{compared} numbers of 20 files compared\n\n| package | parameter | greatest difference | of |\n|---|---|---|---|")
    for (package, what), (off, of) in worst.items():
        print(f"| {package} | {what} | {100 * off:.4f} % | {of} |")
    print("\n" + "\n".join(misses or ["none beyond 0.1 % (Sq, Sa, Ssk, Sku) and 0.5 % (others)"]))
    sys.exit(bool(misses))


main()
