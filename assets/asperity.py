"""Reads a recording of asperity into numpy arrays, in SI.

    pip install rerun-sdk==0.36.3 numpy pillow

    import asperity
    run = asperity.read("demonstration.rrd")
    run.scalars["life_relative"]        # every step; run.scalars["time_s"], run.scalars["p_max_pa"], ...
    run.fields["pressure_pa"].values    # [picture, y, x]; .step and .time_s say which
    run.x_m, run.y_m, run.depths_m
    run.texts["now"]                    # [(step, text), ...]: what stood beside the pictures
    run.ages["worn_nm"]                 # where surfaces age: loading cycles, and [age, body] of both bodies

    pandas.DataFrame(run.scalars)       # the table of all steps

A recording of runs side by side gives `run.runs`, such as `run.runs["a"].scalars`, one of the above for each; the steps of their
pictures and texts are those of the first run.

Fields are those of the contact and what is near it: stresses and films to a 4000th of their colour range or better, what
has a sign in half precision (0.05 %). Scalars have all their digits. What is not known is NaN.
"""

import io
import types

import numpy as np
import PIL.Image
import rerun.experimental as rx

# Entity, name, SI units of one of its own, whether its rows are depths.
FIELDS = [
    ("/maps/pressure_GPa/image", "pressure_pa", 1e9, False),
    ("/maps/film_um/image", "film_m", 1e-6, False),
    ("/maps/traction_on_body_1_MPa/image", "traction_on_body_1_pa", 1e6, False),
    ("/maps/roughness_body_1_um/image", "roughness_1_m", 1e-6, False),
    ("/maps/roughness_body_2_um/image", "roughness_2_m", 1e-6, False),
    ("/maps/surface_1_rise_K/image", "surface_rise_1_k", 1.0, False),
    ("/maps/surface_2_rise_K/image", "surface_rise_2_k", 1.0, False),
    ("/maps/film_rise_K/image", "film_rise_k", 1.0, False),
    ("/slice_y0/effective_stress_GPa/image", "slice_effective_pa", 1e9, True),
    ("/slice_y0/tau_xz_GPa/image", "slice_tau_xz_pa", 1e9, True),
]

# Curves over loading cycles, where surfaces age.
AGES = "/ages_over_cycles/"
# Texts that change, and those that stay.
TEXTS = "/text/"
READ = ("scalars", "buffer", "blob", "meter", "names", "text")


def read(path):
    """Scalars, fields, texts and axes of a recording; of several runs under `runs`."""
    rows = {}
    reader = rx.RrdReader(path)
    for chunk in reader.stream(store=reader.recordings()[0]):
        batch = chunk.to_record_batch()
        timeline = "cycles" if AGES in chunk.entity_path else "step"
        known = timeline in batch.schema.names
        steps = batch.column(timeline).to_pylist() if known else [None] * batch.num_rows
        times = batch.column("simulated_time").cast("int64").to_pylist() if "simulated_time" in batch.schema.names else steps
        for name in batch.schema.names:
            component = name.split(":")[-1]
            if component in READ:
                cells = zip(steps, times, batch.column(name))
                found = rows.setdefault((chunk.entity_path, component), [])
                found.extend((step, time, cell.values) for step, time, cell in cells if cell.is_valid)
    runs = [entity.removesuffix("/grid_si") for entity, component in rows if entity.endswith("/grid_si") and component == "scalars"]
    if runs == [""]:
        return run_of(rows, "")
    return types.SimpleNamespace(runs={run.strip("/"): run_of(rows, run) for run in sorted(runs)})


def run_of(rows, run):
    """One run of those that a recording holds."""
    cells = lambda entity, component: rows.get((run + entity, component), [])
    numbers = lambda cell: cell.to_numpy(zero_copy_only=False)
    fixed = lambda entity: numbers(cells(entity, "scalars")[-1][2])
    _, nx, ny, x_min, dx, y_min, dy = fixed("/grid_si")
    nx, ny = int(nx), int(ny)
    table = sorted(cells("/scalars_si", "scalars"), key=lambda row: row[0])
    names = cells("/scalars_si", "names")[-1][2].to_pylist()
    values = np.array([numbers(cell) for _, _, cell in table])
    fields = {}
    for entity, name, unit, is_below in FIELDS:
        by_step = lambda component: sorted(cells(entity, component), key=lambda row: -1 if row[0] is None else row[0])
        # A list of one blob of bytes: levels with how many of them are one unit, or halves, little-endian.
        levels, halves = by_step("blob"), by_step("buffer")
        pictures = levels or halves
        if not pictures:
            continue
        blobs = [bytes(cell[0].as_py()) for _, _, cell in pictures]
        if levels:
            per_unit = [cell[0].as_py() for _, _, cell in by_step("meter")]
            decoded = [np.asarray(PIL.Image.open(io.BytesIO(blob)), dtype=np.float64) for blob in blobs]
            stack = np.stack([picture / one for picture, one in zip(decoded, per_unit)])
        else:
            stack = np.stack([np.frombuffer(blob, dtype="<f2").reshape(-1, nx) for blob in blobs])
        stack = stack.astype(np.float64) * unit
        fields[name] = types.SimpleNamespace(
            step=np.array([step for step, _, _ in pictures]),
            time_s=np.array([1e-9 * time for _, time, _ in pictures]),
            # Pictures begin with their upper row, which is the last in y.
            values=stack if is_below else stack[:, ::-1, :],
        )
    ages, texts = {}, {}
    for (entity, component), points in rows.items():
        if entity.startswith(run + AGES) and component == "scalars":
            curves = np.array([numbers(cell) for _, _, cell in points])
            ages[entity.removeprefix(run + AGES)] = (np.array([cycles for cycles, _, _ in points]), curves)
        if entity.startswith(run + TEXTS) and component == "text":
            texts[entity.removeprefix(run + TEXTS)] = [(step, cell[0].as_py()) for step, _, cell in points]
    return types.SimpleNamespace(
        ages=ages,
        texts=texts,
        scalars={name: values[:, k] for k, name in enumerate(names)},
        fields=fields,
        x_m=x_min + dx * np.arange(nx),
        y_m=y_min + dy * np.arange(ny),
        depths_m=fixed("/slice_y0/depths_m") if cells("/slice_y0/depths_m", "scalars") else np.array([]),
    )
