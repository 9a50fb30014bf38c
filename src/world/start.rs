//! How an episode starts.

use super::build::any_heading;
use super::pose::Pose;
use super::simulation::{Instance, Simulation};
use crate::eval::{Code, Compiler, Fixed, Layout, TooLarge, run};
use crate::ir::Pool;
use crate::ir::law::{Block, Stmt};
use crate::ir::task::StartLine;
use crate::random::Random;

/// How an episode starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Start {
    /// The seed; with the stream and the number of the episode it decides everything random.
    pub seed: u64,
    /// What the episodes are for, such as learning or evaluation, so that they differ.
    pub stream: u64,
    /// The number of the episode.
    pub episode: u64,
    /// Which of the lists of start lines.
    pub lines: usize,
    /// After how many ticks the episode is cut.
    pub limit: u64,
}

impl Default for Start {
    fn default() -> Self {
        Self {
            seed: 0,
            stream: 0,
            episode: 0,
            lines: 0,
            limit: u64::MAX,
        }
    }
}

/// How often the start lines are run until the robot is free where they put it.
const TRIES: u32 = 10_000;

/// What a start line does.
#[derive(Clone, Debug)]
pub(super) enum StartStep {
    /// Any free pose.
    Anywhere,
    /// Sets the position or the heading.
    Place(Code),
    /// Sets a state.
    Set(Code),
    /// Sets the newest termination.
    Remember(Code),
}

impl StartStep {
    /// What a list of start lines does, in order.
    pub(super) fn list(
        pool: &Pool,
        layout: &mut Layout,
        lines: &[StartLine],
    ) -> Result<Vec<Self>, TooLarge> {
        let has = |test: fn(&StartLine) -> bool| lines.iter().any(test);
        let placed = has(|line| matches!(line, StartLine::Anywhere))
            || has(|line| matches!(line, StartLine::Position(..)))
                && has(|line| matches!(line, StartLine::Heading(_)));
        // What the lines leave open of the pose is drawn before them.
        let mut steps = if placed {
            Vec::new()
        } else {
            vec![Self::Anywhere]
        };
        for line in lines {
            let mut compiler = Compiler::new(pool, layout, None);
            let step: fn(Code) -> Self = match *line {
                StartLine::Anywhere => {
                    steps.push(Self::Anywhere);
                    continue;
                }
                StartLine::Position(x, y) => {
                    compiler.assign_all(&[(Fixed::X.register(), x), (Fixed::Y.register(), y)])?;
                    Self::Place
                }
                StartLine::Heading(heading) => {
                    compiler.assign_all(&[(Fixed::Heading.register(), heading)])?;
                    Self::Place
                }
                StartLine::State(state, value) => {
                    compiler.block(&Block(vec![Stmt::SetState(state, value)]))?;
                    Self::Set
                }
                StartLine::History(code) => {
                    compiler.assign_all(&[(Fixed::History.register(), code)])?;
                    Self::Remember
                }
            };
            steps.push(step(compiler.finish()?));
        }
        Ok(steps)
    }
}

impl Simulation<'_> {
    /// Starts an episode. What it does depends on `start` and on nothing that happened before.
    ///
    /// The lines are run again until the robot is free where they put it; false if that never happens, and it is put
    /// anywhere instead.
    pub fn start(&mut self, start: Start) -> bool {
        self.body.random = Random::new(start.seed, start.stream, start.episode);
        self.clear_tick();
        self.counts.fill(0);
        self.instances.fill(Instance::default());
        self.now = 0;
        self.limit = start.limit;
        self.slack = 0.0;
        let mut free = false;
        for _ in 0..TRIES {
            self.run_start(start.lines);
            if self
                .simulator
                .around
                .scene
                .is_free(self.body.pose.position, self.simulator.radius)
            {
                free = true;
                break;
            }
        }
        if !free {
            self.place_anywhere();
        }
        self.body.atoms = self.history.bits;
        run(
            &self.simulator.compiled.predicates,
            &mut self.registers,
            &mut self.body,
        );
        self.atoms = self.body.atoms;
        free
    }

    fn run_start(&mut self, lines: usize) {
        for &(register, value) in &self.simulator.states {
            self.registers.set(register, value);
        }
        self.registers.set(Fixed::Touching.register(), 0.0);
        self.history.clear();
        self.body.tick();
        let Some(steps) = self.simulator.compiled.starts.get(lines) else {
            self.place_anywhere();
            return;
        };
        for step in steps {
            match step {
                StartStep::Anywhere => self.place_anywhere(),
                StartStep::Set(code) => {
                    run(code, &mut self.registers, &mut self.body);
                }
                StartStep::Place(code) => {
                    run(code, &mut self.registers, &mut self.body);
                    let read = |fixed: Fixed| self.registers.get(fixed.register());
                    let heading = Some(read(Fixed::Heading)).filter(|h| h.is_finite());
                    let pose = Pose::new(
                        [read(Fixed::X), read(Fixed::Y)],
                        heading.unwrap_or_default(),
                    );
                    self.place(pose);
                }
                StartStep::Remember(code) => {
                    run(code, &mut self.registers, &mut self.body);
                    let code = self.registers.get(Fixed::History.register());
                    self.history.clear();
                    if let Some((behavior, status)) = StartLine::termination(code) {
                        let atoms = &self.simulator.atoms;
                        self.history.record(behavior, status, atoms);
                    }
                }
            }
        }
    }

    fn place_anywhere(&mut self) {
        let position = self.simulator.anywhere(&mut self.body.random);
        let heading = any_heading(&mut self.body.random);
        self.place(Pose::new(position, heading));
    }

    /// Puts the robot somewhere.
    fn place(&mut self, pose: Pose) {
        self.body.pose = pose;
        self.slack = 0.0;
        self.publish_pose();
    }
}
