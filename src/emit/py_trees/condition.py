class Condition(Behaviour):
    """Succeeds in the ticks in which a predicate holds, fails in the others."""

    def __init__(self, name: str, holds: Callable[[], bool]) -> None:
        super().__init__(name)
        self.holds = holds

    def update(self) -> Status:
        return Status.SUCCESS if self.holds() else Status.FAILURE
