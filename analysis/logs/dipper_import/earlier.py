"""What an earlier import, and its user since, have left in the folder."""
import shutil
from dataclasses import replace

from dipper_gap.readings.channels import FACE, read_channels
from dipper_run.findings import BadInput

FACES = "profile.csv"  # a survey's, beside the logger's readings


def with_earlier(measured, folder, notes):
    """`measured` with what users add to its channels.yaml; BadInput where it is None, and an earlier one is there."""
    file = folder / "channels.yaml"
    if measured is None and folder.exists():
        raise BadInput([f"{folder}: is of an earlier log, and this one has no forces and no masses by its map; remove "
                        "it, or choose another --out"])
    if measured is None or not file.is_file():
        return measured
    earlier, channels = read_channels(file), dict(measured.channels)
    drifts = {n: c.drift_sigma for n, c in earlier.items() if n in channels and c.drift_sigma is not None}
    channels.update({n: replace(channels[n], drift_sigma=drift) for n, drift in drifts.items()})
    if FACE in earlier:
        channels[FACE] = earlier[FACE]
    kept = [*(f"{n}.drift_sigma" for n in drifts), *([FACE] if FACE in earlier else [])]
    if kept:
        notes.append(f"measured/channels.yaml: {', '.join(kept)} kept, as an earlier one had "
                     f"{'them' if len(kept) > 1 else 'it'}")
    return replace(measured, channels=channels)


def copy_faces(earlier, folder):
    """The faces that the channel face_m stands for, so that the folder can be read as a whole."""
    if (earlier / FACES).is_file():
        shutil.copyfile(earlier / FACES, folder / FACES)
