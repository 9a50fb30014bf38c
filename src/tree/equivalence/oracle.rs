//! Everything that is not determined, one choice after the other.

use crate::ir::tree::Status;

/// Answers choices so that repeated runs go through every combination of answers, in order.
#[derive(Debug, Default)]
pub(super) struct Oracle {
    /// The answers of this run, each with how many there were to choose from.
    script: Vec<(usize, usize)>,
    at: usize,
}

impl Oracle {
    /// One of `0 .. among`; `among` is at least 1.
    pub(super) fn choose(&mut self, among: usize) -> usize {
        let answer = match self.script.get(self.at) {
            Some((answer, _)) => *answer,
            None => {
                self.script.push((0, among));
                0
            }
        };
        self.at += 1;
        answer
    }

    /// One of these; `None` if there are none.
    pub(super) fn pick(&mut self, among: &[usize]) -> Option<usize> {
        let length = among.len();
        (length > 0)
            .then(|| self.choose(length))
            .and_then(|i| among.get(i).copied())
    }

    /// Any of the three.
    pub(super) fn status(&mut self) -> Status {
        match self.choose(3) {
            0 => Status::Running,
            1 => Status::Success,
            _ => Status::Failure,
        }
    }

    /// Goes on to the next combination; false when all have been given.
    pub(super) fn advance(&mut self) -> bool {
        self.at = 0;
        while let Some((answer, among)) = self.script.pop() {
            if answer + 1 < among {
                self.script.push((answer + 1, among));
                return true;
            }
        }
        false
    }
}
