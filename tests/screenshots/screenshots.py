"""Pictures of a recording in the real viewer, without a screen.

    python3 -m venv venv && venv/bin/pip install rerun-sdk==0.36.3 numpy pillow
    venv/bin/python tests/screenshots/screenshots.py recording.rrd assets/screenshots

On a machine without a graphics card the viewer draws in software; on Debian and Ubuntu that needs

    apt-get install --no-install-recommends mesa-vulkan-drivers libvulkan1 libgl1 libegl1 \
        libxkbcommon-x11-0 libxkbcommon0 libxcursor1 libxi6 libxrandr2 libx11-xcb1 libwayland-client0

`--sheet SHEET.png` puts every tab into one small picture too, as the `all_...` are: a recording, a size and a theme each.
A tab's picture is taken when it differs from the tab before and two looks at it are the same.

`--measure` takes no pictures: it prints the file's size, the seconds until the viewer shows the first tab filled, and the viewer's
memory ten seconds later and after another twenty in which it plays.

One picture per tab of the layout that the recording brings with it: `contact.png`, `maps.png`, ...
The viewer follows the theme of the system; `--theme light` or `--theme dark` draws in its browser form with that theme
asked for, which needs `pip install playwright` and Chromium (`--chromium PATH`).

The viewer knows no command for choosing a tab, so the recording's own layout is sent to it once per
tab with that tab made the active one. The layout's cameras and bounds rest on a convention of the
viewer (`src/recorder/layout.rs`): if a picture shows the default camera, it no longer holds.
"""

import argparse
import contextlib
import io
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

import numpy as np
import rerun as rr
import rerun.blueprint.archetypes as blueprint_archetypes
import rerun.experimental as rx
import rerun_bindings as bindings

VERSION = "0.36.3"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", type=pathlib.Path, help=".rrd file")
    parser.add_argument("folder", type=pathlib.Path, help="where the pictures go")
    parser.add_argument("--sheet", type=pathlib.Path, help="also all of them in this one picture")
    parser.add_argument("--size", default="1600x900", help="window size in pixels (default: %(default)s)")
    parser.add_argument("--port", type=int, default=9988, help="free port (default: %(default)s)")
    parser.add_argument("--wait", type=float, default=15.0, help="seconds for loading (default: %(default)s)")
    parser.add_argument("--settle", type=float, default=4.0, help="seconds between two looks at a tab (default: %(default)s)")
    parser.add_argument("--patience", type=float, default=90.0, help="most seconds for a tab (default: %(default)s)")
    parser.add_argument("--measure", action="store_true", help="time to the first picture and memory instead")
    parser.add_argument("--theme", choices=["light", "dark"], help="theme of the viewer in a browser (default: no browser)")
    parser.add_argument("--chromium", default="/usr/bin/chromium", help="browser for --theme (default: %(default)s)")
    return parser.parse_args()


def layout(recording):
    """Application, chunks of the layout, and (name, path) of its tabs."""
    reader = rx.RrdReader(recording)
    entry = reader.blueprints()[0]
    chunks = list(reader.stream(store=entry))
    column = {}
    for chunk in chunks:
        batch = chunk.to_record_batch()
        for name in batch.schema.names:
            column[(chunk.entity_path, name)] = batch.column(name)

    def value(path, component):
        for (entity, name), array in column.items():
            if entity == path and name.endswith(component):
                return array[0].as_py()
        return None

    root_bytes = value("/viewport", "root_container")[0]
    root = "/container/" + str(uuid_of(root_bytes))
    tabs = []
    for child in value(root, "contents"):
        path = "/" + child.lstrip("/")
        tabs.append((value(path, "display_name")[0], child))
    return entry.application_id, chunks, root, tabs


def uuid_of(raw):
    """An identifier however the arrow column spells it."""
    import uuid

    raw = raw.get("bytes", raw) if isinstance(raw, dict) else raw
    return uuid.UUID(bytes=bytes(raw))


def activate(application, chunks, root, tab, url):
    """Sends the layout again with one tab in front."""
    stream = rr.RecordingStream._from_native(
        bindings.new_blueprint(
            application_id=application,
            make_default=False,
            make_thread_default=False,
            default_enabled=True,
        )
    )
    stream.set_time("blueprint", sequence=0)
    rx.send_chunks(chunks, recording=stream)
    stream.set_time("blueprint", sequence=1)
    change = blueprint_archetypes.ContainerBlueprint.from_fields(active_tab=tab)
    stream.log(root, change)
    # Stands still on the last step.
    stream.log("/time_panel", blueprint_archetypes.TimePanelBlueprint.from_fields(play_state="Following", loop_mode="Off"))
    bindings.connect_grpc_blueprint(url, True, True, stream.to_native())


def connect(url, seconds):
    """Waits for the viewer."""
    until = time.monotonic() + seconds
    while True:
        try:
            return rx.ViewerClient.connect(url)
        except Exception:
            if time.monotonic() > until:
                raise
            time.sleep(0.5)


@contextlib.contextmanager
def viewer(arguments, options):
    """The viewer's process, ended when done; a group of its own: the command is a script that starts the viewer proper."""
    program = pathlib.Path(sys.executable).parent / "rerun"
    command = [program, "--bind", "127.0.0.1", "--port", str(arguments.port), "--memory-limit", "2GB", *options]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    process = subprocess.Popen([*command, arguments.recording], start_new_session=True, **quiet)
    try:
        yield process.pid
    finally:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait()


@contextlib.contextmanager
def native(arguments, url):
    """Takes a picture of the viewer itself."""
    with viewer(arguments, ["--headless", "--window-size", arguments.size]):
        client = connect(url, arguments.wait)
        time.sleep(arguments.wait)
        yield lambda file: client.save_screenshot(str(file.resolve()))


@contextlib.contextmanager
def in_browser(arguments, url):
    """Takes a picture of the viewer in a browser that asks for a theme."""
    from playwright.sync_api import sync_playwright

    width, height = map(int, arguments.size.split("x"))
    web_port = arguments.port + 1
    with viewer(arguments, ["--serve-web", "--web-viewer-port", str(web_port)]), sync_playwright() as playwright:
        time.sleep(3)
        software = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        browser = playwright.chromium.launch(executable_path=arguments.chromium, args=software)
        page = browser.new_page(viewport={"width": width, "height": height}, color_scheme=arguments.theme)
        page.goto(f"http://127.0.0.1:{web_port}/?renderer=webgl&url={url.replace('+', '%2B')}")
        time.sleep(arguments.wait)
        yield lambda file: page.screenshot(path=str(file), timeout=120_000)
        browser.close()


def written(file, seconds=30):
    """The whole picture, waited for: the viewer writes it in its own time, may begin it anew, and is ended after the last."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        picture = file.read_bytes() if file.exists() else b""
        if picture[-8:-4] == b"IEND":
            return picture
        time.sleep(0.2)
    sys.exit(f"{file} was not written")


def share_that_differs(one, other):
    """Share of the pixels that are not the same in two pictures."""
    from PIL import Image

    first, second = (np.asarray(Image.open(io.BytesIO(raw)).convert("RGB"), dtype=int) for raw in (one, other))
    return np.mean(np.abs(first - second).max(axis=2) > 8)


def first_look(save, arguments):
    """The picture of the viewer as it opened, which is not kept."""
    file = arguments.folder / "as_it_opened.png"
    file.unlink(missing_ok=True)
    save(file)
    written(file)
    picture = file.read_bytes()
    file.unlink()
    return picture


def picture_of_tab(save, file, before, arguments):
    """Saves a tab's picture once it is another than the one `before` and stands still: a busy machine draws late."""
    until = time.monotonic() + arguments.patience
    last = None
    while time.monotonic() < until:
        time.sleep(arguments.settle)
        file.unlink(missing_ok=True)
        save(file)
        picture = written(file)
        other_than_before = share_that_differs(before, picture) > 0.02
        stands_still = last is not None and share_that_differs(last, picture) < 0.002
        if other_than_before and stands_still:
            return picture
        last = picture
    sys.exit(f"{file}: no picture of its own that stands still within {arguments.patience:.0f} s")


def save_sheet(files, sheet):
    """All pictures in two columns, in few colours: what the viewer draws has few."""
    from PIL import Image

    gap, columns = 4, 2
    width = (1284 - gap) // columns
    small = []
    for file in files:
        picture = Image.open(file).convert("RGB")
        small.append(picture.resize((width, picture.height * width // picture.width), Image.Resampling.LANCZOS))
    height = small[0].height + gap
    rows = -(-len(small) // columns)
    whole = Image.new("RGB", (columns * (width + gap) - gap, rows * height - gap), (90, 90, 90))
    for place, picture in enumerate(small):
        whole.paste(picture, (place % columns * (width + gap), place // columns * height))
    # Refined, or colours that few pixels have would become those of others.
    few = whole.quantize(96, method=Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
    few.save(sheet, optimize=True)
    print(sheet, flush=True)


def resident_mb(group):
    """Resident memory of a group of processes, MB."""
    pages = 0
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError, ValueError):
            if os.getpgid(int(folder.name)) == group:
                pages += int((folder / "statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def measure(arguments, url):
    """Prints how heavy a recording is, and how soon and how large the viewer is with it."""
    from PIL import Image

    begun = time.monotonic()
    with viewer(arguments, ["--headless", "--window-size", arguments.size]) as group:
        client = connect(url, arguments.patience)
        while time.monotonic() - begun < arguments.patience:
            file = arguments.folder / "measured.png"
            file.unlink(missing_ok=True)
            client.save_screenshot(str(file.resolve()))
            left = np.asarray(Image.open(io.BytesIO(written(file))).convert("RGB"))[:, : 400, :]
            # The first tab has its largest picture at the left; before it is drawn there is one colour or two.
            if len(np.unique(left.reshape(-1, 3) // 16, axis=0)) > 40:
                break
        shown = time.monotonic() - begun
        memory = []
        for seconds in (10, 20):
            time.sleep(seconds)
            memory.append(resident_mb(group))
        file.unlink(missing_ok=True)
    size = arguments.recording.stat().st_size / 1e6
    print(f"{arguments.recording}: {size:.1f} MB, first picture after {shown:.1f} s, {memory[0]:.0f} MB resident, {memory[1]:.0f} MB when played")


def main():
    arguments = parse_arguments()
    if rr.__version__ != VERSION:
        sys.exit(f"rerun-sdk {rr.__version__} is installed; the recording is of {VERSION}")
    arguments.folder.mkdir(parents=True, exist_ok=True)
    application, chunks, root, tabs = layout(arguments.recording)
    url = f"rerun+http://127.0.0.1:{arguments.port}/proxy"
    if arguments.measure:
        return measure(arguments, url)
    shown = in_browser if arguments.theme else native
    files = []
    with shown(arguments, url) as save:
        picture = first_look(save, arguments)
        # The first tab last: as the viewer opens it is in front, and stands still before it has been filled.
        for name, tab in tabs[1:] + tabs[:1]:
            activate(application, chunks, root, tab, url)
            file = arguments.folder / (re.sub(r"[^a-z0-9]+", "_", name.lower()) + ".png")
            picture = picture_of_tab(save, file, picture, arguments)
            files.append(file)
            print(file, flush=True)
    if arguments.sheet:
        save_sheet(files[-1:] + files[:-1], arguments.sheet)


if __name__ == "__main__":
    main()
