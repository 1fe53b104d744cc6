"""Studies through a real Slurm on this machine: submitted, killed, a node lost, interrupted, gone on with."""
import os
import signal
import time

import pytest

from cluster import Cluster
from world import HERE, STUDY, World

STUDY = STUDY.replace("[60, 62, 64]", "[60, 62]").replace("[1, 2, 3]", "[1, 2]") + "executor: slurm\n"
TINY = HERE.parents[1] / "coupler/run/tiny"


@pytest.fixture(scope="module")
def cluster():
    with Cluster() as made:
        yield made


@pytest.fixture
def world(tmp_path, cluster):
    world = World(tmp_path)
    world.environment["SLURM_CONF"] = cluster.environment["SLURM_CONF"]
    yield world
    assert not cluster.jobs() and not world.left()


def running(world, cluster, count):
    """The queue's tasks, once so many of their runs have begun and go on."""
    until = time.monotonic() + 60
    while True:
        jobs = [j for j in cluster.jobs() if j[1] == "RUNNING"]
        if len(jobs) >= count and len(world.calls()) >= count:
            return jobs
        assert time.monotonic() < until, cluster.jobs()
        time.sleep(0.1)


def end(study, status=0):
    out, err = study.communicate(timeout=120)
    assert study.returncode == status, out + err
    return out + err


def test_a_killed_task_and_a_node_that_is_gone_are_made_again(world, cluster):
    world.say("slow", "4")
    study = world.start(STUDY)
    jobs = running(world, cluster, 2)
    assert {node for _, _, node in jobs} == {"n1", "n2"}
    killed, lost = sorted(jobs, key=lambda job: job[2])
    cluster.ask("scancel", "--signal=KILL", "--full", killed[0])
    cluster.ask("scontrol", "update", "NodeName=n2", "State=DOWN", "Reason=test")
    world.say("slow", "0.1")
    said = end(study)
    cluster.ask("scontrol", "update", "NodeName=n2", "State=RESUME")
    assert "at a time, 1 rank each, through Slurm (2 cores)" in said and "4 of 4 runs done, 0 failed" in said
    assert len(world.calls()) == 6 and all(r["status"] == "complete" for r in world.rows())
    assert "4 of them kept" in world.study(STUDY) and len(world.calls()) == 6


def test_a_run_that_fails_is_not_repeated_one_that_is_lost_is_as_often_as_said(world, cluster):
    world.say("fail", "2")
    world.say("slow", "3")
    study = world.start(STUDY + "slurm: {retries: 0}\n")
    first = running(world, cluster, 2)[0]
    cluster.ask("scancel", "--signal=KILL", "--full", first[0])
    world.say("slow", "0.1")
    said = end(study, 3)
    assert "run lost 1 times" in said and "status 3; see" in said
    before = len(world.calls())
    assert before == 4
    world.say("fail", "")
    world.study(STUDY)  # goes on
    assert {r["status"] for r in world.rows()} == {"complete"} and len(world.calls()) <= before + 3


def test_an_interrupt_cancels_and_the_same_command_goes_on(world, cluster):
    world.say("slow", "30")
    study = world.start(STUDY)
    running(world, cluster, 2)
    study.send_signal(signal.SIGINT)
    assert "continues from the finished runs" in end(study, 4)
    assert not cluster.jobs()
    world.say("slow", "0.1")
    world.study(STUDY)
    assert {r["status"] for r in world.rows()} == {"complete"}


def test_a_detached_study_is_watched_cancelled_and_collected_by_later_calls(world, cluster):
    world.say("slow", "2")
    assert "4 runs are with Slurm" in world.study(STUDY, "--detach")
    assert len(cluster.jobs()) == 4
    world.study(STUDY, "--detach")  # nothing is submitted twice
    assert len(cluster.jobs()) <= 4
    world.study(STUDY)
    assert len(world.calls()) == 4 and {r["status"] for r in world.rows()} == {"complete"}
    more = STUDY.replace("[60, 62]", "[60, 63]")
    world.say("slow", "30")
    world.study(more, "--detach")
    assert "2 jobs cancelled" in world.study(more, "--cancel")


def test_without_slurm_it_is_bad_input(world):
    assert "slurm.partition: narrow: has no cores" in world.study(STUDY + "slurm: {partition: narrow}\n", status=2)
    world.environment["PATH"] = "/nowhere"
    assert "executor: slurm, but sinfo" in world.study(STUDY, status=2)


def test_a_real_run_of_two_ranks(world, cluster):
    """The tiny case by the program itself: its ranks are started where Slurm put the task."""
    world.environment["DIPPER"] = os.environ["DIPPER"]
    world.study(f"""case: {TINY}
seeds: [5]
ranks: 2
set: {{end_s: 0.06, pile.settle_s: 0.1, pile.relax_s: 0.05}}
parameters: {{machine.rake_angle_deg: [61]}}
executor: slurm
slurm: {{partition: wide}}
""")
    # It ends before the door opens.
    assert [r["status"] for r in world.rows()] == ["unfinished"] and float(world.rows()[0]["cpu_s"]) > 0
