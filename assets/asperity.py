"""Reads a recording of asperity into numpy arrays, in SI.

    pip install rerun-sdk==0.36.3 numpy pillow

    import asperity
    run = asperity.read("demonstration.rrd")
    run.scalars["life_relative"]        # every step; run.scalars["time_s"], run.scalars["p_max_pa"], ...
    run.fields["pressure_pa"].values    # [picture, y, x]; .step says which
    run.x_m, run.y_m, run.depths_m
    run.ages["worn_nm"]                 # where surfaces age: loading cycles, and [age, body] of both bodies

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


def read(path):
    """Scalars, fields and axes of a recording."""
    rows = {}
    reader = rx.RrdReader(path)
    for chunk in reader.stream(store=reader.recordings()[0]):
        batch = chunk.to_record_batch()
        for name in batch.schema.names:
            component = name.split(":")[-1]
            if component in ("scalars", "buffer", "blob", "meter", "names"):
                timeline = "cycles" if chunk.entity_path.startswith(AGES) else "step"
                known = timeline in batch.schema.names
                steps = batch.column(timeline).to_pylist() if known else [None] * batch.num_rows
                cells = batch.column(name)
                rows.setdefault((chunk.entity_path, component), []).extend(
                    (step, cell.values) for step, cell in zip(steps, cells) if cell.is_valid
                )
    fixed = lambda entity: rows[(entity, "scalars")][-1][1].to_numpy(zero_copy_only=False)
    _, nx, ny, x_min, dx, y_min, dy = fixed("/grid_si")
    nx, ny = int(nx), int(ny)
    table = sorted(rows[("/scalars_si", "scalars")], key=lambda row: row[0])
    names = rows[("/scalars_si", "names")][-1][1].to_pylist()
    values = np.array([cell.to_numpy(zero_copy_only=False) for _, cell in table])
    fields = {}
    for entity, name, unit, is_below in FIELDS:
        by_step = lambda component: sorted(rows.get((entity, component), []), key=lambda row: row[0])
        # A list of one blob of bytes: levels with how many of them are one unit, or halves, little-endian.
        levels, halves = by_step("blob"), by_step("buffer")
        pictures = levels or halves
        if not pictures:
            continue
        blobs = [bytes(cell[0].as_py()) for _, cell in pictures]
        if levels:
            per_unit = [cell[0].as_py() for _, cell in by_step("meter")]
            decoded = [np.asarray(PIL.Image.open(io.BytesIO(blob)), dtype=np.float64) for blob in blobs]
            stack = np.stack([picture / one for picture, one in zip(decoded, per_unit)])
        else:
            stack = np.stack([np.frombuffer(blob, dtype="<f2").reshape(-1, nx) for blob in blobs])
        stack = stack.astype(np.float64) * unit
        fields[name] = types.SimpleNamespace(
            step=np.array([step for step, _ in pictures]),
            # Pictures begin with their upper row, which is the last in y.
            values=stack if is_below else stack[:, ::-1, :],
        )
    ages = {}
    for (entity, component), points in rows.items():
        if entity.startswith(AGES) and component == "scalars":
            curves = np.array([cell.to_numpy(zero_copy_only=False) for _, cell in points])
            ages[entity.removeprefix(AGES)] = (np.array([cycles for cycles, _ in points]), curves)
    return types.SimpleNamespace(
        ages=ages,
        scalars={name: values[:, k] for k, name in enumerate(names)},
        fields=fields,
        x_m=x_min + dx * np.arange(nx),
        y_m=y_min + dy * np.arange(ny),
        depths_m=fixed("/slice_y0/depths_m") if ("/slice_y0/depths_m", "scalars") in rows else np.array([]),
    )
