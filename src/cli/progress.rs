//! A progress bar on standard error, on a terminal only.

use crate::driver::learn::Stage;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;

/// Shows how far the learning has come.
#[derive(Debug)]
pub(super) struct Progress(ProgressBar);

impl Progress {
    /// A bar that is not there if standard error is no terminal.
    pub(super) fn new() -> Self {
        let bar = if std::io::stderr().is_terminal() {
            ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr())
        } else {
            ProgressBar::hidden()
        };
        if let Ok(style) = ProgressStyle::with_template("{msg:12} {wide_bar} {percent:>3} %  {eta}")
        {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// Shows a stage.
    pub(super) fn show(&self, stage: Stage) {
        match stage {
            Stage::Learning(done, all) => {
                if done == 1 {
                    self.0.set_message("learning");
                    self.0.set_length(all);
                }
                // A redraw takes longer than an episode.
                if done % 64 == 0 || done == all {
                    self.0.set_position(done);
                }
            }
            Stage::Validating => self.0.set_message("validating"),
            Stage::RollingOut => self.0.set_message("rolling out"),
            Stage::Proving => self.0.set_message("proving"),
            Stage::Simplifying => self.0.set_message("simplifying"),
            Stage::Testing => self.0.set_message("testing"),
        }
    }

    /// Takes the bar away.
    pub(super) fn finish(&self) {
        self.0.finish_and_clear();
    }
}
