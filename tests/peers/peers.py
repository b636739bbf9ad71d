#!/usr/bin/env python3
"""Dry and subsurface contact by tamaas and ContactMechanics beside asperity: error and CPU seconds.

Not part of CI. Needs Python 3.11 or newer with venv, a package index, and Cargo:

    python3 tests/peers/peers.py --out assets/reports/peers.md

The first run makes an environment beside the build (--venv, default target/peers-venv) from requirements.txt, and the
script starts itself again in it. Everything runs on one thread. Times are CPU seconds of the working thread, of the
solution alone and of making what it needs (kernels, plans, memory): the peers' best of three, asperity's mean of many
(`tests/study/peers.rs`; the counter that it reads is coarse).

Cases (steel, E 210 GPa, nu 0.3, R 10 mm, p0 1 GPa; n intervals or pixels a side)
  hertz           non-periodic, domain 3 a, from a uniform pressure; error 1: greatest pressure, error 2: L2 of the field
  bisinusoidal m  gap 1 - cos cos, periodic, mean pressure m p*; errors: greatest pressure and contact area against
                  assets/reference/dry.csv (three codes agree to its digits at 512^2)
  subsurface      greatest von Mises under a Hertz pressure against 0.620041 p0; tamaas is periodic there: box 6 a.
                  ContactMechanics has no stress below the surface. Error 1: refined between depths where the code does
                  so, error 2: at its own points
"""

import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
REPEATS = 3
STEEL = dict(young_pa=210e9, poisson=0.3, radius_m=0.01, p0_pa=1e9)
BISINUSOIDAL = [(0.05, 0.70940, 0.11335), (0.2, 1.09553, 0.34644), (0.5, 1.47934, 0.70510)]
VON_MISES = 0.620041
COLUMNS = ["case", "code", "n", "tolerance", "error_1", "error_2", "solve_cpu_s", "setup_cpu_s", "iterations"]


def in_environment(venv):
    """Starts the script again inside its own environment."""
    python = venv / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", str(venv)], check=True)
        requirements = str(HERE / "requirements.txt")
        subprocess.run([str(python), "-m", "pip", "install", "--quiet", "-r", requirements], check=True)
    threads = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
    os.execve(str(python), [str(python), *sys.argv, "--inside"], {**os.environ, **threads})


def best(prepare, solve):
    """Last result, best CPU seconds of preparing and of solving."""
    made, solved, result = float("inf"), float("inf"), None
    for _ in range(REPEATS):
        clock = time.process_time()
        prepared = prepare()
        made = min(made, time.process_time() - clock)
        clock = time.process_time()
        result = solve(prepared)
        solved = min(solved, time.process_time() - clock)
    return result, made, solved


def row(case, code, n, tolerance, errors, made, solved, iterations):
    shown = [f"{error:.3e}" if error is not None else "" for error in errors]
    return dict(zip(COLUMNS, [case, code, n, f"{tolerance:g}", *shown, f"{solved:.4f}", f"{made:.4f}", iterations]))


def constants():
    import numpy as np

    e_star = STEEL["young_pa"] / (2 * (1 - STEEL["poisson"] ** 2))
    a = np.pi * STEEL["p0_pa"] * STEEL["radius_m"] / (2 * e_star)
    return e_star, a, 2 * np.pi * a * a * STEEL["p0_pa"] / 3


def sphere(n):
    """Heights of a sphere over 3 a, and r in a."""
    import numpy as np

    _, a, _ = constants()
    side = 3 * a
    x = np.arange(n) * side / n - side / 2
    grid_x, grid_y = np.meshgrid(x, x, indexing="ij")
    square = grid_x**2 + grid_y**2
    return side, -square / (2 * STEEL["radius_m"]), np.sqrt(square) / a


def hertz_errors(pressure, r):
    import numpy as np

    exact = np.sqrt(np.clip(1 - r * r, 0, None))
    p = pressure / STEEL["p0_pa"]
    return abs(p.max() - 1), np.sqrt(((p - exact) ** 2).sum() / (exact**2).sum())


def tamaas_hertz(n, tolerance):
    import tamaas as tm

    e_star, _, force = constants()
    side, heights, r = sphere(n)

    def prepare():
        model = tm.Model(tm.model_type.basic_2d, [side, side], [n, n])
        model.E, model.nu = e_star, 0.0
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver = tm.PolonskyKeerRey(model, heights, tolerance)
        solver.setIntegralOperator("dcfft")
        return model, solver

    def solve(prepared):
        prepared[1].solve(force / side**2)
        return prepared[0].traction[...].copy()

    pressure, made, solved = best(prepare, solve)
    return row("hertz", "tamaas", n, tolerance, hertz_errors(pressure, r), made, solved, "")


def contact_mechanics_hertz(n, tolerance):
    from ContactMechanics import FreeFFTElasticHalfSpace, make_system
    from SurfaceTopography import Topography

    e_star, a, force = constants()
    side, heights, r = sphere(n)

    def prepare():
        half_space = FreeFFTElasticHalfSpace((n, n), e_star, (side, side))
        topography = Topography(heights, physical_sizes=(side, side))
        return make_system(interaction="hardwall", substrate=half_space, surface=topography)

    def solve(system):
        # Overlap allowed: a tolerance times the approach.
        overlap = tolerance * a * a / STEEL["radius_m"]
        result = system.minimize_proxy(external_force=force, pentol=overlap, maxiter=1000)
        assert result.success, result.message
        return abs(system.substrate.force[:n, :n]) * (n / side) ** 2, result.nit

    (pressure, iterations), made, solved = best(prepare, solve)
    return row("hertz", "ContactMechanics", n, tolerance, hertz_errors(pressure, r), made, solved, iterations)


def waves(n):
    import numpy as np

    x = np.arange(n) / n
    grid_x, grid_y = np.meshgrid(x, x, indexing="ij")
    return np.cos(2 * np.pi * grid_x) * np.cos(2 * np.pi * grid_y)


def wave_errors(pressure, p_star, table):
    _, p_max, area = table
    found = (pressure > 1e-9 * p_star).mean()
    return abs(pressure.max() / p_star / p_max - 1), abs(found / area - 1)


def tamaas_bisinusoidal(n, tolerance, table):
    import numpy as np
    import tamaas as tm

    p_star = np.sqrt(2) * np.pi

    def prepare():
        model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
        model.E, model.nu = 1.0, 0.0
        return model, tm.PolonskyKeerRey(model, waves(n), tolerance)

    def solve(prepared):
        prepared[1].solve(table[0] * p_star)
        return prepared[0].traction[...].copy()

    pressure, made, solved = best(prepare, solve)
    errors = wave_errors(pressure, p_star, table)
    return row(f"bisinusoidal {table[0]}", "tamaas", n, tolerance, errors, made, solved, "")


def contact_mechanics_bisinusoidal(n, tolerance, table):
    import numpy as np
    from ContactMechanics import PeriodicFFTElasticHalfSpace, make_system
    from SurfaceTopography import Topography

    p_star = np.sqrt(2) * np.pi

    def prepare():
        half_space = PeriodicFFTElasticHalfSpace((n, n), 1.0, (1.0, 1.0))
        topography = Topography(waves(n), physical_sizes=(1.0, 1.0), periodic=True)
        return make_system(interaction="hardwall", substrate=half_space, surface=topography)

    def solve(system):
        result = system.minimize_proxy(external_force=table[0] * p_star, pentol=tolerance, maxiter=1000)
        assert result.success, result.message
        return abs(system.substrate.force) * n * n, result.nit

    (pressure, iterations), made, solved = best(prepare, solve)
    errors = wave_errors(pressure, p_star, table)
    return row(f"bisinusoidal {table[0]}", "ContactMechanics", n, tolerance, errors, made, solved, iterations)


def tamaas_subsurface(n, depths):
    import numpy as np
    import tamaas as tm

    side, depth = 6.0, 3.0
    x = np.arange(n) * side / n - side / 2
    grid_x, grid_y = np.meshgrid(x, x, indexing="ij")
    pressure = np.sqrt(np.clip(1 - grid_x**2 - grid_y**2, 0, None))

    def prepare():
        model = tm.Model(tm.model_type.volume_2d, [depth, side, side], [depths, n, n])
        model.E, model.nu = 1.0, STEEL["poisson"]
        tm.ModelFactory.registerVolumeOperators(model)
        model.traction[..., 2] = pressure
        strain = np.zeros((depths, n, n, 6))
        return model, strain, np.zeros_like(strain)

    def solve(prepared):
        model, strain, stress = prepared
        model.operators["boussinesq_gradient"](model.traction, strain)
        model.operators["hooke"](strain, stress)
        s = np.moveaxis(stress, -1, 0)
        normal = (s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2
        # Shear components carry a factor of the square root of two (Mandel).
        return np.sqrt(0.5 * normal + 1.5 * (s[3] ** 2 + s[4] ** 2 + s[5] ** 2)).max()

    greatest, made, solved = best(prepare, solve)
    errors = (None, abs(greatest / VON_MISES - 1))
    return row(f"subsurface, {depths} depths", "tamaas", n, 0, errors, made, solved, 1)


def ours(quick):
    command = "cargo test --locked --release --package asperity-study --test study -- --ignored --exact peers::table".split()
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "peers.csv"
        variables = os.environ | {"ASPERITY_PEERS": str(path)} | ({"ASPERITY_PEERS_N": "128"} if quick else {})
        subprocess.run(command, check=True, cwd=ROOT, env=variables, stdout=subprocess.DEVNULL)
        return list(csv.DictReader(path.open()))


def theirs(quick):
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    for n in [128] if quick else [128, 256, 512]:
        yield tamaas_hertz(n, 1e-6)
        yield tamaas_hertz(n, 1e-8)
        yield contact_mechanics_hertz(n, 1e-4)
        yield contact_mechanics_hertz(n, 1e-6)
        for table in BISINUSOIDAL:
            yield tamaas_bisinusoidal(n, 1e-8, table)
            yield contact_mechanics_bisinusoidal(n, 1e-6, table)
        if n <= 128:
            yield tamaas_subsurface(n, 32)
        if n <= 128 and not quick:
            yield tamaas_subsurface(n, 96)


def verdict(rows):
    """Dry Hertz at equal error (within 1 % of the best field error of its size) against the fastest peer."""
    lines = []
    for n in sorted({int(r["n"]) for r in rows if r["case"] == "hertz"}):
        of_size = [r for r in rows if r["case"] == "hertz" and int(r["n"]) == n]
        least = min(float(r["error_2"]) for r in of_size)
        good = [r for r in of_size if float(r["error_2"]) <= 1.01 * least]
        for what, time_of in [
            ("solution", lambda r: float(r["solve_cpu_s"])),
            ("solution and set-up", lambda r: float(r["solve_cpu_s"]) + float(r["setup_cpu_s"])),
        ]:
            own = min((time_of(r) for r in good if r["code"] == "asperity"), default=float("inf"))
            others = [r for r in good if r["code"] != "asperity"]
            if others:
                fastest = min(others, key=time_of)
                lines.append(
                    f"- Hertz, n = {n}, {what}: {own / time_of(fastest):.3f} of the CPU time of the fastest peer "
                    f"({fastest['code']}, tolerance {fastest['tolerance']})"
                )
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--venv", type=pathlib.Path, default=ROOT / "target/peers-venv")
    parser.add_argument("--out", type=pathlib.Path, help="report to write, Markdown")
    parser.add_argument("--quick", action="store_true", help="128^2 only")
    parser.add_argument("--inside", action="store_true", help=argparse.SUPPRESS)
    args = parser.parse_args()
    if not args.inside:
        in_environment(args.venv)
    rows = ours(args.quick) + list(theirs(args.quick))
    rows.sort(key=lambda r: (r["case"], int(r["n"])))
    lines = ["# Peers", "", "`python3 tests/peers/peers.py`; versions: " +
             ", ".join((HERE / "requirements.txt").read_text().split()) + ". CPU seconds, one thread.", ""]
    lines.append("| " + " | ".join(COLUMNS) + " |")
    lines.append("|---" * len(COLUMNS) + "|")
    lines += ["| " + " | ".join(str(r[name]) for name in COLUMNS) + " |" for r in rows]
    lines += ["", *verdict(rows), ""]
    text = "\n".join(lines)
    print(text)
    if args.out:
        args.out.write_text(text)


if __name__ == "__main__":
    main()
