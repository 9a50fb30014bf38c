class Limit(Timeout):
    """Fails once its time is over, without another tick of its child."""

    def tick(self) -> Iterator[Behaviour]:
        if self.status == Status.RUNNING and time.monotonic() > self.finish_time:
            self.stop(Status.FAILURE)
            self.status = Status.FAILURE
            yield self
        else:
            yield from super().tick()
