//! A progress bar on standard error, on a terminal only, where a command takes longer than two seconds.

use crate::driver::learn::Stage;
use crate::driver::tune;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::time::Duration;

/// A command that takes no longer shows no bar.
const PATIENCE: Duration = Duration::from_secs(2);
/// The time between two redraws of a bar that does not move.
const BEAT: Duration = Duration::from_millis(200);

/// Shows how far a command has come.
#[derive(Debug)]
pub(super) struct Progress {
    bar: ProgressBar,
    /// Dropped when the command is done, which ends the wait for the bar.
    _done: Sender<()>,
}

impl Progress {
    /// A bar that comes when the command takes long, and never if standard error is not a terminal.
    pub(super) fn new() -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        let (done, wait) = mpsc::channel::<()>();
        if std::io::stderr().is_terminal() {
            let bar = bar.clone();
            // Where the system gives no thread, there is no bar.
            let showing = std::thread::Builder::new().spawn(move || {
                if wait.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                    bar.enable_steady_tick(BEAT);
                }
            });
            drop(showing);
        }
        if let Ok(style) = ProgressStyle::with_template("{msg:14} {spinner} {elapsed}") {
            bar.set_style(style);
        }
        Self { bar, _done: done }
    }

    /// Shows a stage whose length is not known.
    pub(super) fn stage(&self, name: &'static str) {
        self.bar.set_message(name);
    }

    /// Shows a stage of this length.
    fn measured(&self, name: &'static str, length: u64) {
        let template = "{msg:14} {wide_bar} {percent:>3} %  {eta}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            self.bar.set_style(style);
        }
        self.bar.set_message(name);
        self.bar.set_length(length);
    }

    /// Shows a stage of learning.
    pub(super) fn show(&self, stage: Stage) {
        match stage {
            Stage::Learning(done, all) => {
                if done == 1 {
                    self.measured("learning", all);
                }
                // A redraw takes longer than an episode.
                if done % 64 == 0 || done == all {
                    self.bar.set_position(done);
                }
            }
            Stage::Validating => self.stage("validating"),
            Stage::RollingOut => self.stage("rolling out"),
            Stage::Proving => self.stage("proving"),
            Stage::Improving => self.stage("improving"),
            Stage::Growing(done, all) => {
                self.measured("growing", all);
                self.bar.set_position(done.min(all));
            }
            Stage::Testing => self.stage("testing"),
        }
    }

    /// Shows a stage of the search for better values.
    pub(super) fn tune(&self, stage: tune::Stage) {
        match stage {
            tune::Stage::Learning(stage) => self.show(stage),
            tune::Stage::Tuning(heard) => {
                self.measured("tuning", heard.of);
                self.bar.set_position(heard.ticks.min(heard.of));
            }
        }
    }

    /// Takes the bar away.
    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
