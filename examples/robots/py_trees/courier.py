"""A courier in a corridor of three stations, driven by a tree that was learned in another world.

    btc learn examples/delivery_small.bt -o learned
    PYTHONPATH=learned python examples/robots/py_trees/courier.py
"""

import sys

from learned import Robot, create_root
from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.trees import BehaviourTree

STATIONS = {"A": 0, "C": 3, "B": 6}


class Courier(Robot):
    """The robot, and the corridor around it."""

    def __init__(self) -> None:
        self.ticks = 0
        self.position = 2
        self.battery = 100
        self.delivered = 0
        self.carrying = False
        self.holds: dict[str, bool] = {}

    def begin_tick(self) -> None:
        """Notes what holds as the tick begins, which is what the tree asks."""
        self.ticks += 1
        self.battery -= 3
        self.holds = {"carrying": self.carrying, "low": self.battery <= 25}

    def carrying_package(self) -> bool:
        return self.holds["carrying"]

    def battery_low(self) -> bool:
        return self.holds["low"]

    def goto(self, target: str) -> Behaviour:
        return Goto(self, target)

    def dock(self, station: str) -> Behaviour:
        return Dock(self, station)

    def ended(self, behavior: str, status: Status) -> Status:
        print(
            f"tick {self.ticks:2}  {behavior} {status.value}, battery {self.battery} %"
        )
        return status


class Goto(Behaviour):
    """A step towards a station in each tick."""

    def __init__(self, courier: Courier, target: str) -> None:
        super().__init__(f"goto({target})")
        self.courier = courier
        self.target = target

    def update(self) -> Status:
        courier, place = self.courier, STATIONS[self.target]
        courier.position += (place > courier.position) - (place < courier.position)
        if courier.position != place:
            return Status.RUNNING
        if self.target == "A":
            courier.carrying = True
        elif self.target == "B" and courier.carrying:
            courier.carrying = False
            courier.delivered += 1
        return courier.ended(self.name, Status.SUCCESS)


class Dock(Behaviour):
    """Fills the battery at a station, which takes three ticks."""

    def __init__(self, courier: Courier, station: str) -> None:
        super().__init__(f"dock({station})")
        self.courier = courier
        self.station = station
        self.docked = 0

    def initialise(self) -> None:
        self.docked = 0

    def update(self) -> Status:
        courier = self.courier
        if courier.position != STATIONS[self.station]:
            return courier.ended(self.name, Status.FAILURE)
        self.docked += 1
        if self.docked < 3:
            return Status.RUNNING
        courier.battery = 100
        return courier.ended(self.name, Status.SUCCESS)


def main() -> int:
    courier = Courier()
    tree = BehaviourTree(create_root(courier))
    while courier.delivered < 4 and courier.battery > 0:
        courier.begin_tick()
        # On a robot: every 100 ms, as the module says.
        tree.tick()
    print(f"{courier.delivered} packages, battery {courier.battery} %")
    return 0 if courier.delivered == 4 else 1


if __name__ == "__main__":
    sys.exit(main())
