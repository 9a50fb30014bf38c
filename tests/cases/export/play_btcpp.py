"""Reads a job from standard input, plays it with BehaviorTree.CPP, and prints what the trees did.

A job has the leaves of the files, each a condition or a behaviour of some position, with
its id and its ports, and plays, each a file with what its robot meets. All in JSON.

The Python bindings register no ports, so each leaf is registered as an id of its own.
"""

import json
import sys
from xml.etree import ElementTree

from behaviortreepy import BehaviorTreeFactory, NodeStatus

STATUS = {"S": NodeStatus.SUCCESS, "F": NodeStatus.FAILURE, "R": NodeStatus.RUNNING}
LETTER = {status: letter for letter, status in STATUS.items()}


class Stage:
    """What the robot meets in a play."""

    def __init__(self, play):
        self.play = play
        self.values = None
        self.call = 0
        self.calls = []

    def condition(self, atom):
        def tick(node):
            holds = self.values[atom] == "1"
            return NodeStatus.SUCCESS if holds else NodeStatus.FAILURE

        return tick

    def action(self, behavior):
        def tick(node):
            answers = self.play["answers"]
            answer = answers[self.call % len(answers)]
            self.call += 1
            self.calls.append(behavior)
            if self.play["steady"] and behavior % 2 == 0 and answer == "F":
                answer = "S"
            return STATUS[answer]

        return tick


def played(play, leaves):
    stage = Stage(play)
    factory = BehaviorTreeFactory()
    registered = set()
    root = ElementTree.fromstring(play["file"])
    for element in root.find("BehaviorTree").iter():
        ports = {
            k: v for k, v in element.attrib.items() if k != "name" and k[0] != "_"
        }
        leaf = leaves.get((element.tag, json.dumps(ports, sort_keys=True)))
        if leaf is None:
            continue
        acts, position = leaf
        element.tag = f"{'action' if acts else 'condition'}_{position}"
        marks = {k: v for k, v in element.attrib.items() if k[0] == "_"}
        element.attrib.clear()
        element.attrib.update(marks)
        if element.tag in registered:
            continue
        registered.add(element.tag)
        if acts:
            tick = stage.action(position)
            factory.register_simple_stateful_action(element.tag, tick, tick)
        else:
            factory.register_simple_condition(element.tag, stage.condition(position))
    tree = factory.create_tree_from_text(ElementTree.tostring(root, encoding="unicode"))
    ticks = []
    for values in play["valuations"]:
        stage.values = values
        stage.calls = []
        status = tree.tick_exactly_once()
        ticks.append([stage.calls, LETTER[status]])
    return ticks


def main():
    job = json.load(sys.stdin)
    leaves = {
        (id, json.dumps(ports, sort_keys=True)): (acts, position)
        for acts, position, id, ports in job["leaves"]
    }
    json.dump({"plays": [played(play, leaves) for play in job["plays"]]}, sys.stdout)


main()
