class Step(Decorator):
    """Ends one tick after its child has ended like this with a behaviour at work."""

    def __init__(self, name: str, child: Behaviour, on: Status) -> None:
        super().__init__(name, child)
        self.on = on
        self.waits = False

    def update(self) -> Status:
        return self.decorated.status

    def tick(self) -> Iterator[Behaviour]:
        waited = self.status == Status.RUNNING and self.waits
        self.waits = False
        status = self.on
        if not waited:
            drove = False
            for node in self.decorated.tick():
                drove = drove or is_at_work(node)
                yield node
            status = self.decorated.status
            self.waits = drove and status == self.on
        if self.waits:
            status = Status.RUNNING
        elif status != Status.RUNNING:
            self.stop(status)
        self.status = status
        yield self


def is_at_work(node: Behaviour) -> bool:
    """Whether a node is a behaviour of the robot, and not one that only asks or waits."""
    return not node.children and type(node).__name__ not in (
        "Condition",
        "Failure",
        "Success",
        "TickCounter",
    )
