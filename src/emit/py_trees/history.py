class History:
    """{doc}

    What ends in a tick is asked for from the next tick on.
    """

    def __init__({parameters}) -> None:
        self.of = of
        self.window: deque[tuple[str, Status]] = deque(maxlen=last)
        self.ended: list[tuple[str, Status]] = []

    def done(self, behavior: str) -> bool:
        return (behavior, Status.SUCCESS) in self.window

    def failed(self, behavior: str) -> bool:
        return (behavior, Status.FAILURE) in self.window

    def note(self, behavior: str, status: Status) -> None:
        """Takes in that a behaviour has ended."""
        if status in self.of:
            self.ended.append((behavior, status))

    def begin_tick(self) -> None:
        self.window.extend(self.ended)
        self.ended.clear()


class Noted(Decorator):
    """A behaviour of the robot; the history notes how it ends."""

    def __init__(self, name: str, child: Behaviour, history: History) -> None:
        super().__init__(name, child)
        self.history = history

    def update(self) -> Status:
        self.history.note(self.name, self.decorated.status)
        return self.decorated.status


class Remembering(Decorator):
    """The tree, whose history moves on from tick to tick."""

    def __init__(self, name: str, child: Behaviour, history: History) -> None:
        super().__init__(name, child)
        self.history = history

    def update(self) -> Status:
        return self.decorated.status

    def tick(self) -> Iterator[Behaviour]:
        self.history.begin_tick()
        yield from super().tick()
