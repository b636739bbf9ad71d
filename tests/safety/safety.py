"""What becomes of a recording when things go wrong, with the release binary and the real reader.

    python3 -m venv venv && venv/bin/pip install rerun-sdk==0.36.3 numpy
    venv/bin/python tests/safety/safety.py target/release/asperity [kill|disk|live|memory|memory129|cost|table|fields|footer ...]

kill    twenty runs ended by SIGKILL at random moments: every file opens and holds all but the last second
disk    a full disk (a small tmpfs where that may be mounted) and a folder that may not be written: a clear
        message, exit code 4, no panic, what was written before can be read
live    a real viewer (without a screen) that is closed or freezes in mid-run: the run goes on and tells what was
        skipped
memory  twenty thousand steps of 65 nodes, recorded and not: resident memory after the first tenth and at the end
memory129  the same with the nodes of the presets (five to ten minutes each)
cost    the default scene with and without a recording in turns; ratio of the steps per second
table   recorded h_min and life against the CSV of the same run, to rounding
fields  what assets/asperity.py reads against the CSV, of every preset, with heat, in rolling and side by side: greatest
        pressure and least film of every picture
footer  a run that is stopped and let go on a hundred times: the viewer's own tool finds nothing wrong with its file

Moments and timings vary from run to run, which is why this is a script to look at and not a unit test; it
ends with code 1 when something does not hold.
"""

import csv
import os
import pathlib
import random
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

import numpy as np
import rerun.experimental as rx

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "assets"))
import asperity

SMALL = ["--set", "grid.nodes=65", "--set", "numerics.error_estimate=none"]
failures = []


def check(holds, what):
    print(("ok    " if holds else "FAILS ") + what, flush=True)
    if not holds:
        failures.append(what)


def scalars(path, entity, column="Scalars:scalars"):
    """Values of an entity by step (column None: just the steps), as far as the file can be read."""
    found = {}
    try:
        for chunk in rx.RrdReader(path).stream():
            if chunk.entity_path != "/" + entity or chunk.is_static:
                continue
            batch = chunk.to_record_batch()
            steps = batch.column(batch.schema.get_field_index("step")).to_pylist()
            if column is None:
                found.update((step, None) for step in steps)
                continue
            name = next(n for n in batch.schema.names if n.endswith(column))
            found.update(zip(steps, batch.column(name).to_pylist()))
    except Exception as error:  # a file that breaks off is read up to there
        print("      reader:", error)
    return found


def run(program, *arguments, **more):
    command = [program, "run", *arguments]
    return subprocess.run(command, capture_output=True, text=True, **more)


def kill(program, folder):
    random.seed(1)
    for number in range(20):
        out, table = folder / f"{number}.rrd", folder / f"{number}.csv"
        command = [program, "run", *SMALL, "--passages", "1000", "--out", out, "--table", table]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        # At any moment, the start-up of half a second included.
        until = time.monotonic() + random.uniform(0.3, 6.0)
        rows = [(0.0, 0)]  # (moment, last step in the table)
        while time.monotonic() < until:
            if table.exists():
                rows.append((time.monotonic(), max(0, table.read_text().count("\n") - 1)))
            time.sleep(0.02)
        process.kill()
        moment = time.monotonic()
        process.wait()
        held = max(scalars(out, "series/film_um"), default=0)
        shown = max(scalars(out, "maps/pressure_GPa/image", None), default=0)
        least = min(held, shown)
        # What is not in the file was not in the table either a second before.
        lost = moment - max((when for when, steps in rows if steps <= least), default=moment)
        what = f"kill {number + 1:2}: holds step {held}, pictures to step {shown}, of {rows[-1][1]}; {max(lost, 0):.2f} s are lost"
        check(lost < 1.0, what)


def disk(program, folder):
    small = folder / "small"
    small.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16m", "tmpfs", small]).returncode == 0
    if mounted:
        try:
            done = run(program, *SMALL, "--passages", "20", "--out", small / "run.rrd")
            check(done.returncode == 4, f"full disk: exit code {done.returncode}")
            check("panick" not in done.stderr and "No space left" in done.stderr, "full disk: " + done.stderr.strip()[:160])
            held = len(scalars(small / "run.rrd", "series/film_um"))
            check(held > 0, f"full disk: {held} steps can be read")
        finally:
            subprocess.run(["umount", small])
    else:
        print("no tmpfs may be mounted here: full disk not tried")
    done = run(program, *SMALL, "--out", "/proc/nowhere/run.rrd")
    check(done.returncode == 4 and "panick" not in done.stderr, "unwritable: " + done.stderr.strip()[:160])


def memory(program, folder, nodes=65):
    # A passage takes as many steps as the grid has cells.
    length = ["--set", f"grid.nodes={nodes}", "--passages", str(-(-20_000 // (nodes - 1)))]
    for name, record in (("recorded", ["--set", "record.budget_mb=30", "--out", folder / "long.rrd"]), ("not recorded", ["--no-record"])):
        table = folder / f"{name}.csv"
        command = [program, "run", *SMALL, *length, *record, "--table", table]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        seen = []
        while process.poll() is None:
            time.sleep(0.5)
            status = pathlib.Path(f"/proc/{process.pid}/status")
            if table.exists() and status.exists():
                found = re.search(r"VmRSS:\s+(\d+)", status.read_text())
                steps = table.read_text().count("\n") - 1
                if found and steps > 0:
                    seen.append((steps, int(found[1]) / 1024))
        # After the last step the recording is bound, which takes a chunk of each entity into memory: apart from the steps.
        total = seen[-1][0]
        stepping = [rss for steps, rss in seen if steps < total]
        last = stepping[-1]
        early = next(rss for steps, rss in seen if steps >= 0.1 * total)
        growth = last / early - 1
        what = f"{early:.1f} MB after a tenth, {last:.1f} MB before the last of {total} steps: {100 * growth:+.1f} %"
        check(abs(growth) < 0.03, f"memory, {nodes} nodes, {name}: {what}")
        bound = max(rss for steps, rss in seen if steps == total) - last
        check(bound < 64, f"memory, {nodes} nodes, {name}, at the end: {bound:+.1f} MB")


def memory129(program, folder):
    memory(program, folder, 129)


def live(program, folder):
    """A real viewer that is closed, or freezes, in mid-run."""
    viewer = pathlib.Path(sys.executable).parent / "rerun"
    ends = (("closed", signal.SIGKILL), ("frozen", signal.SIGSTOP))
    for port, (name, end) in enumerate(ends, 9971):
        shown = subprocess.Popen(
            [viewer, "--headless", "--bind", "127.0.0.1", "--port", str(port), "--memory-limit", "1GB"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            wait_for(port)
            table = folder / f"{name}.csv"
            command = [program, "run", *SMALL, "--passages", "40", "--no-record", f"--connect=127.0.0.1:{port}"]
            done = subprocess.Popen([*command, "--table", table], stdout=subprocess.PIPE, text=True)
            while not (table.exists() and table.read_text().count("\n") > 200):
                time.sleep(0.05)
            os.killpg(shown.pid, end)
            text = done.communicate()[0]
            rows = table.read_text().count("\n") - 1
            line = next((line for line in text.splitlines() if "viewer at" in line), "").strip()
            check(done.returncode == 0 and rows >= 2560, f"viewer {name}: all {rows} steps were made")
            check("skipped" in line, f"viewer {name}: {line}")
        finally:
            os.killpg(shown.pid, signal.SIGKILL)
            shown.wait()


def wait_for(port):
    for _ in range(600):
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                return
        time.sleep(0.1)
    sys.exit("the viewer did not start")


def cost(program, folder):
    pairs = []
    for number in range(3):
        rates = []
        for record in (["--no-record"], ["--out", folder / f"cost{number}.rrd"]):
            done = run(program, "--passages", "1", "--set", "numerics.error_estimate=none", "--summary", "-", *record)
            rates.append(float(re.search(r'"steps_per_s": ([0-9.e+-]+)', done.stdout)[1]))
        pairs.append(rates[0] / rates[1] - 1)
        print(f"      {rates[0]:.2f} steps/s without, {rates[1]:.2f} with: {100 * pairs[-1]:+.1f} %", flush=True)
    middle = sorted(pairs)[1]
    check(middle < 0.05, f"cost: recording adds {100 * middle:.1f} % (median of three)")
    size = (folder / "cost0.rrd").stat().st_size / 1e6
    check(size < 60, f"size: one passage of the default scene takes {size:.1f} MB")


def table(program, folder):
    out, path = folder / "run.rrd", folder / "run.csv"
    done = run(program, *SMALL, "--passages", "2", "--out", out, "--table", path)
    check(done.returncode == 0, f"run: exit code {done.returncode} {done.stderr.strip()[:200]}")
    rows = {int(row["step"]): row for row in csv.DictReader(path.open())}
    film = scalars(out, "series/film_um")
    life = scalars(out, "life/relative")
    check(sorted(film) == sorted(rows), f"table: {len(film)} steps in both")
    pairs = [(film[step][2], 1e6 * float(row["h_min_m"])) for step, row in rows.items()]
    check(np.allclose(*zip(*pairs), rtol=1e-6, atol=0), f"table: h_min of {len(pairs)} steps agrees to 1e-6")
    pairs = [(life[step][0], float(row["life_relative"])) for step, row in rows.items() if row["life_relative"]]
    check(len(pairs) > 0 and len(pairs) == len(life), f"table: life in {len(pairs)} steps of both")
    check(np.allclose(*zip(*pairs), rtol=1e-6, atol=0), f"table: life of {len(pairs)} steps agrees to 1e-6")


def fields(program, folder):
    warm = ["--set", "heat.bulk_k=360", "--set", "heat.thermal_conductivity_w_mk=0.14"]
    presets = re.findall(r"^([a-z_]+)  ", subprocess.run([program, "scenes"], capture_output=True, text=True).stdout, re.M)
    scenes = [(name, [name]) for name in presets]
    scenes += [("warm", ["demonstration", *warm]), ("rolling", ["demonstration", "--set", "motion.slide_roll=0"])]
    for name, scene in scenes:
        out, path = folder / f"{name}.rrd", folder / f"{name}.csv"
        # Short waves need nodes.
        nodes = "257" if name.startswith("random") else "129" if name.startswith(("fzg", "cam")) else "65"
        done = run(program, *scene, "--nodes", nodes, "--passages", "1", "--out", out, "--table", path)
        check(done.returncode == 0, f"{name}: exit code {done.returncode} {done.stderr.strip()[:200]}")
        if done.returncode != 0:
            continue
        rows = {int(row["step"]): row for row in csv.DictReader(path.open())}
        read = asperity.read(out)
        pressure, film = read.fields["pressure_pa"], read.fields["film_m"]
        alike = pressure.values.shape[1:] == (len(read.y_m), len(read.x_m)) and pressure.step[-1] == max(rows)
        check(alike, f"{name}: {pressure.values.shape} as the axes, the last picture of the last step, {max(rows)}")
        of = lambda column, steps: np.array([float(rows[step][column]) for step in steps])
        off = np.abs(pressure.values.max(axis=(1, 2)) / of("p_max_pa", pressure.step) - 1).max()
        check(off < 3e-4, f"{name}: greatest pressure of {len(pressure.step)} pictures within {100 * off:.3f} %")
        # The table has the least film under pressure: where none is, it may be less. Half a level of ranges up to 4 um.
        under = np.where(pressure.values > 0, film.values, np.inf).min(axis=(1, 2)) - of("h_min_m", film.step)
        below = (film.values.min(axis=(1, 2)) - of("h_min_m", film.step)).max()
        worst = max(-under.min(), below)
        check(worst < 1.3e-10, f"{name}: least film of {len(film.step)} pictures within {1e9 * worst:.3f} nm")
        check(("surface_rise_1_k" in read.fields) == (name == "warm"), f"{name}: temperatures where there is heat")
        life = rows[max(rows)]["life_relative"]
        check(not life or np.isclose(read.scalars["life_relative"][-1], float(life)), f"{name}: life {life}")
    out = folder / "both.rrd"
    done = run(program, "demonstration", *SMALL[:2], "--passages", "1", "--beside", "motion.slide_roll=0,0.5", "--out", out)
    check(done.returncode == 0, f"beside: exit code {done.returncode} {done.stderr.strip()[:200]}")
    runs = asperity.read(out).runs
    for name, slide_roll in (("a", 0.0), ("b", 0.5)):
        found = runs[name]
        check(np.all(found.scalars["slide_roll"] == slide_roll), f"beside: S = {slide_roll} in run {name}")
        greatest = found.fields["pressure_pa"].values.max(axis=(1, 2)).max()
        off = abs(greatest / found.scalars["p_max_pa"].max() - 1)
        check(off < 0.05, f"beside: greatest pressure of run {name} in pictures within {100 * off:.2f} % of that of all steps")
        words = found.texts["lecture"][-1][1]
        check(f"S = {slide_roll:g}" in words or f"S = {slide_roll:.3f}" in words, f"beside: the text of run {name} says its S")


def footer(program, folder):
    """The clock goes on while the run stands: rows are sent in many more parts than on a quiet machine."""
    random.seed(2)
    viewer = pathlib.Path(sys.executable).parent / "rerun"
    for number, halts in enumerate((0, 100)):
        out = folder / f"{number}.rrd"
        command = [program, "run", *SMALL, "--passages", "8", "--out", out]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        for _ in range(halts):
            time.sleep(0.02)
            if process.poll() is None:
                process.send_signal(signal.SIGSTOP)
                time.sleep(random.uniform(0.0, 0.4))
                process.send_signal(signal.SIGCONT)
        process.wait()
        seen = subprocess.run([viewer, "rrd", "verify", out], capture_output=True, text=True)
        check(process.returncode == 0 and seen.returncode == 0, f"footer, {halts} halts: verify ends with {seen.returncode}")
        chunks = sorted((c.entity_path, c.num_rows) for c in rx.RrdReader(out).stream() if not c.is_static)
        if number == 0:
            quiet = chunks
        check(chunks == quiet, f"footer, {halts} halts: {len(chunks)} chunks, the same as on a quiet machine")


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    parts = {"kill": kill, "disk": disk, "live": live, "memory": memory, "memory129": memory129, "cost": cost, "table": table, "fields": fields, "footer": footer}
    for name in sys.argv[2:] or [name for name in parts if name != "memory129"]:
        with tempfile.TemporaryDirectory() as folder:
            parts[name](program, pathlib.Path(folder))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
