"""Reads a job from standard input, plays it with py_trees, and prints what the trees did.

A job has the modules of single conditions and single behaviours, in order; plays, each a
module with what its robot meets; and modules to run as programs. All in JSON.
"""

import contextlib
import inspect
import io
import json
import sys
import time
import types

from py_trees.behaviour import Behaviour
from py_trees.common import Status

STATUS = {"S": Status.SUCCESS, "F": Status.FAILURE, "R": Status.RUNNING}
LETTER = {status: letter for letter, status in STATUS.items()}
TICK = 0.1


class Clock:
    """Time that goes on from tick to tick, and a little whenever it is looked at."""

    def __init__(self):
        self.tick = 0
        self.looks = 0

    def __call__(self):
        self.looks += 1
        return self.tick * TICK + self.looks * 1e-9


class Actor(Behaviour):
    """A behaviour that answers as the stage says."""

    def __init__(self, key, stage):
        super().__init__(repr(key))
        self.key = key
        self.stage = stage

    def update(self):
        return self.stage.acts(self.key)


class Rehearsal:
    """Notes what a single leaf calls."""

    def holds(self, key):
        self.key = key
        return True

    def acts(self, key):
        self.key = key
        return Status.SUCCESS


class Stage:
    """What the robot meets in a play."""

    def __init__(self, play, conditions, behaviors):
        self.play = play
        self.conditions = conditions
        self.behaviors = behaviors
        self.values = None
        self.call = 0
        self.calls = []

    def holds(self, key):
        return self.values[self.conditions[key]] == "1"

    def acts(self, key):
        behavior = self.behaviors[key]
        answer = self.play["answers"][self.call % len(self.play["answers"])]
        self.call += 1
        self.calls.append(behavior)
        if self.play["steady"] and behavior % 2 == 0 and answer == "F":
            answer = "S"
        return STATUS[answer]


class Script:
    """A history that is what the stage says."""

    def __init__(self, stage):
        self.stage = stage

    def done(self, behavior):
        return self.stage.holds(("done", (("behavior", behavior),)))

    def failed(self, behavior):
        return self.stage.holds(("failed", (("behavior", behavior),)))

    def note(self, behavior, status):
        pass

    def begin_tick(self):
        pass


def module(text, name="tree"):
    made = types.ModuleType(name)
    exec(compile(text, name, "exec"), made.__dict__)
    return made


def robot(made, stage):
    """A robot that passes on what its methods are called with."""

    def method(name):
        declared = getattr(made.Robot, name)
        signature = inspect.signature(declared)

        def called(self, *args, **kwargs):
            bound = signature.bind(self, *args, **kwargs).arguments
            given = tuple(sorted((k, v) for k, v in bound.items() if k != "self"))
            key = (name, given)
            if signature.return_annotation is bool:
                return stage.holds(key)
            return Actor(key, stage)

        return called

    methods = {name: method(name) for name in made.Robot.__abstractmethods__}
    return type("Player", (made.Robot,), methods)()


def root(made, stage, remembers=False):
    """The tree of a module; it remembers what its behaviours did, or is told what they did."""
    player = robot(made, stage)
    if remembers or not hasattr(made, "History"):
        return made.create_root(player)
    return made.create_root(player, Script(stage))


def keys(texts):
    """What each leaf calls, with its position."""
    found = {}
    for position, text in enumerate(texts):
        if not text:
            continue
        made = module(text)
        rehearsal = Rehearsal()
        root(made, rehearsal).tick_once()
        assert rehearsal.key not in found, rehearsal.key
        found[rehearsal.key] = position
    return found


def played(play, clock, conditions, behaviors):
    made = module(play["module"])
    stage = Stage(play, conditions, behaviors)
    tree = root(made, stage, play["remembers"])
    ticks = []
    for tick, values in enumerate(play["valuations"]):
        clock.tick = tick
        stage.values = values
        stage.calls = []
        tree.tick_once()
        ticks.append([stage.calls, LETTER[tree.status]])
    return ticks


def drawn(text):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        module(text, "__main__")
    return out.getvalue()


def main():
    job = json.load(sys.stdin)
    clock = Clock()
    time.monotonic = clock
    conditions = keys(job["conditions"])
    behaviors = keys(job["behaviors"])
    answer = {
        "plays": [played(play, clock, conditions, behaviors) for play in job["plays"]],
        "drawn": [drawn(text) for text in job["programs"]],
    }
    json.dump(answer, sys.stdout)


main()
