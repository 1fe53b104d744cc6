"""What is known of the model's errors: read beside the case, taken out of runs, its interval kept as an error."""
from dataclasses import replace

import numpy as np
import pytest

import synthetic
from dipper_gap.readings.features import Cell
from dipper_gap.readings.fidelity import Factor, Fidelity, known_errors, read_fidelity, rock_forces
from dipper_gap.readings.vectors import Vectors, indices_of
from dipper_run.findings import BadInput

EMPTY = synthetic.run({"no_rock": 1})
PLAIN = [synthetic.run({}, seed) for seed in (1, 2, 3)]
STATED = Fidelity(Factor(0.90, 0.86, 0.94), 0.1, Factor(0.95, 0.90, 1.00))
RIGHT = """dig_force: {factor: 0.726, low: 0.698, high: 0.755, by_phase: 0.15, source: a study}
payload: {factor: 0.99, low: 0.96, high: 1.03, source: "a study"}
not_compared: [face_m]
"""


def dig_force(m):
    """Mean over the passes of the mean dig force, from first contact to the dump."""
    out = []
    for phases in synthetic.phase_index():
        at = (m.time_s >= phases["penetrate"][0]) & (m.time_s < phases["dump"][0])
        out.append(np.hypot(m.signals["hoist_force_kN"], m.signals["crowd_force_kN"])[at].mean())
    return np.mean(out)


@pytest.fixture(scope="module")
def known():
    return known_errors(STATED, EMPTY, PLAIN)


def test_a_file_beside_the_case_is_read(tmp_path):
    assert read_fidelity(tmp_path) is None
    (tmp_path / "fidelity.yaml").write_text(RIGHT)
    stated = read_fidelity(tmp_path)
    assert stated.dig_force == Factor(0.726, 0.698, 0.755) and stated.by_phase == 0.15
    assert stated.payload == Factor(0.99, 0.96, 1.03) and stated.not_compared == ("face_m",)
    assert stated.dig_force.spread == pytest.approx(0.057 / 3.92 / 0.726)
    assert "0.726 (0.698 to 0.755)" in str(stated) and "face_m not compared" in str(stated)


@pytest.mark.parametrize("wrong, right, said", [
    ("low: 0.698", "low: 0.8", "fidelity.yaml:1: dig_force.factor: is 0.726; between low, 0.8, and high"),
    ("factor: 0.726", "factor: much", "fidelity.yaml:1: dig_force.factor: is much; a number above 0"),
    (", by_phase: 0.15", "", "fidelity.yaml:1: dig_force.by_phase: missing; a relative sd, 0 to 1"),
    (", source: a study", "", "fidelity.yaml:1: dig_force.source: missing"),
    ("[face_m]", "[hoist_m]", "fidelity.yaml:3: not_compared: has hoist_m; of hoist_force_kN"),
    ("payload:", "load:", "fidelity.yaml:2: load: unknown key")])
def test_faults_name_file_line_and_key(tmp_path, wrong, right, said):
    (tmp_path / "fidelity.yaml").write_text(RIGHT.replace(wrong, right))
    with pytest.raises(BadInput) as e:
        read_fidelity(tmp_path)
    assert said in str(e.value)


def test_rock_shows_resistance_in_the_dig_and_weight_from_then_on():
    m = PLAIN[0]
    for name, resists, weighs in rock_forces(m, EMPTY):
        assert m.signals[name] - EMPTY.signals[name] == pytest.approx(resists + weighs, abs=1e-9)
        for phases in synthetic.phase_index():
            after = (m.time_s >= phases["swing"][0]) & (m.time_s < phases["return"][1])
            before = (m.time_s >= phases["approach"][0]) & (m.time_s < phases["penetrate"][0])
            assert not resists[after].any() and not weighs[before].any()
    hoist = {n: w for n, _, w in rock_forces(m, EMPTY)}["hoist_force_kN"]
    swing = synthetic.phase_index()[0]["swing"]
    tonnes = m.passes[0].truck_mass_t
    assert hoist[(m.time_s >= swing[0]) & (m.time_s < swing[1])].mean() == pytest.approx(0.9 * 9.81 * tonnes, rel=0.03)


def test_the_dig_force_of_corrected_runs_is_the_stated_share(known):
    only_dig = known_errors(replace(STATED, payload=Factor()), EMPTY, PLAIN)
    ratio = [dig_force(only_dig.corrected(m)) / dig_force(m) for m in PLAIN]
    assert np.mean(ratio) == pytest.approx(0.90, abs=0.005)
    assert only_dig.resistance.value < 0.90  # dipper and load weigh what they do, so rock has to resist less
    m, seen = PLAIN[0], known.corrected(PLAIN[0])
    assert [p.truck_mass_t for p in seen.passes] == pytest.approx([0.95 * p.truck_mass_t for p in m.passes])
    back = synthetic.phase_index()[0]["return"]
    at = (m.time_s > back[0] + 1) & (m.time_s < back[1])
    assert np.allclose(seen.signals["hoist_force_kN"][at], m.signals["hoist_force_kN"][at], atol=1.0)


def test_a_share_below_what_the_weights_need_is_an_error():
    with pytest.raises(BadInput, match="dipper and load alone need"):
        known_errors(Fidelity(Factor(0.1, 0.1, 0.1)), EMPTY, PLAIN)


def test_what_is_not_known_is_a_shared_shift_of_features(known):
    """One sd of each direction moves what it should, and nothing else."""
    runs = [known.corrected(m) for m in PLAIN]
    vectors = Vectors(synthetic.CHANNELS, [1, 2, 3], runs)
    cells = vectors.cells

    def rows_of(folders):
        return np.array([row[indices_of(cells, of)] for of, row in map(vectors.of_run, folders)])

    directions = known.directions(runs, rows_of, cells)
    index = {c: i for i, c in enumerate(cells)}
    mean = rows_of(runs).mean(axis=0)
    resistance, payload = directions[:2]
    fill, swing, mass = (index[c] for c in (Cell(1, "fill", "crowd_force_kN", "mean"),
                                            Cell(1, "swing", "hoist_force_kN", "mean"),
                                            Cell(1, "dump", "truck_mass_t", "mass")))
    assert resistance[swing] == pytest.approx(0.0, abs=1.0) and resistance[mass] == pytest.approx(0.0, abs=1e-9)
    at = [(m.time_s >= a) & (m.time_s < b) for m in runs for a, b in [synthetic.phase_index()[0]["fill"]]]
    resists = np.mean([rock_forces(m, EMPTY)[1][1][k].mean() for m, k in zip(runs, at)])
    assert resistance[fill] == pytest.approx(known.resistance.spread * resists, rel=0.15)
    assert payload[mass] == pytest.approx(STATED.payload.spread * mean[mass])
    assert payload[swing] > 0
    others = directions[2:]
    for phase in ("penetrate", "fill", "breakout", "dump"):
        at = [i for i, c in enumerate(cells) if (c.phase, c.channel) == (phase, "hoist_force_kN")]
        alone = [row for row in others if row[at].any() and not np.delete(row, at).any()]
        assert len(alone) == 2 or (phase == "dump" and alone)  # early in the phase, and late: no load is left there
    at_rest = [i for i, c in enumerate(cells) if c.phase == "return"]
    assert not directions[:, at_rest].any()
