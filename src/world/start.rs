//! How an episode starts.

use super::build::any_heading;
use super::door::Door;
use super::pose::Pose;
use super::simulation::{Instance, Simulation};
use crate::eval::{Code, Compiler, Fixed, Layout, TooLarge, run};
use crate::geometry::{Point, dot, minus};
use crate::ir::expr;
use crate::ir::task::{Placing, StartLine};
use crate::ir::{Id, Pool};
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

/// How often they are run to see which robot is not.
const LOOKED: u32 = 1_000;

/// Where the number of a place is held while the robot is put there, which sets it anew.
const WHICH: Fixed = Fixed::X;

/// What a start line does.
#[derive(Clone, Debug)]
pub(super) enum StartStep {
    /// Any free pose.
    Anywhere,
    /// Any free pose in the place of the number that this sets.
    Within(Code),
    /// Sets the position or the heading.
    Place(Code),
    /// Any free pose of another robot, by its place among them.
    OtherAnywhere(usize),
    /// The same in a place.
    OtherWithin(usize, Code),
    /// Sets the position or the heading of another robot.
    OtherPlace(usize, Code),
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
        others: usize,
    ) -> Result<Vec<Self>, TooLarge> {
        let has = |test: fn(&StartLine) -> bool| lines.iter().any(test);
        let placed = has(|line| matches!(line, StartLine::Anywhere(_)))
            || has(|line| matches!(line, StartLine::Position(..)))
                && has(|line| matches!(line, StartLine::Heading(_)));
        // What the lines leave open of the pose is drawn before them.
        let mut steps = if placed {
            Vec::new()
        } else {
            vec![Self::Anywhere]
        };
        for other in 0..others {
            let placed = |wanted: fn(&Placing) -> bool| {
                lines.iter().any(|line| {
                    matches!(line, StartLine::Other(id, placing)
                        if id.index() == other + 1 && wanted(placing))
                })
            };
            let whole = placed(|it| matches!(it, Placing::Anywhere(_)))
                || placed(|it| matches!(it, Placing::Position(..)))
                    && placed(|it| matches!(it, Placing::Heading(_)));
            if !whole {
                steps.push(Self::OtherAnywhere(other));
            }
        }
        for line in lines {
            let mut compiler = Compiler::new(pool, layout, None);
            if let &StartLine::Other(id, placing) = line {
                let other = id.index().saturating_sub(1);
                match placing {
                    Placing::Anywhere(None) => {
                        steps.push(Self::OtherAnywhere(other));
                        continue;
                    }
                    Placing::Anywhere(Some(place)) => {
                        compiler.assign_all(&[(WHICH.register(), place)])?;
                        steps.push(Self::OtherWithin(other, compiler.finish()?));
                        continue;
                    }
                    Placing::Position(x, y) => {
                        let [to_x, to_y] = [expr::Pose::X, expr::Pose::Y]
                            .map(|coordinate| compiler.robot_register(id, coordinate));
                        compiler.assign_all(&[(to_x, x), (to_y, y)])?;
                    }
                    Placing::Heading(heading) => {
                        let to = compiler.robot_register(id, expr::Pose::Heading);
                        compiler.assign_all(&[(to, heading)])?;
                    }
                }
                steps.push(Self::OtherPlace(other, compiler.finish()?));
                continue;
            }
            let step: fn(Code) -> Self = match *line {
                StartLine::Other(..) => continue,
                StartLine::Anywhere(None) => {
                    steps.push(Self::Anywhere);
                    continue;
                }
                StartLine::Anywhere(Some(place)) => {
                    compiler.assign_all(&[(WHICH.register(), place)])?;
                    Self::Within
                }
                StartLine::Position(x, y) => {
                    compiler.assign_all(&[(Fixed::X.register(), x), (Fixed::Y.register(), y)])?;
                    Self::Place
                }
                StartLine::Heading(heading) => {
                    compiler.assign_all(&[(Fixed::Heading.register(), heading)])?;
                    Self::Place
                }
                StartLine::State(ref parts) => {
                    let parts: Vec<_> = parts
                        .iter()
                        .map(|&(state, value)| (compiler.state_register(state), value))
                        .collect();
                    compiler.assign_all(&parts)?;
                    Self::Set
                }
                StartLine::Member(_, ref block) => {
                    compiler.block(block)?;
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
        self.simulator.warm(self.now);
        self.body.random = Random::new(start.seed, start.stream, start.episode);
        self.clear_tick();
        self.counts.fill(0);
        self.instances.fill(Instance::default());
        self.now = 0;
        self.limit = start.limit;
        self.slack = 0.0;
        for (other, stream) in self.others.iter_mut().zip(1..) {
            // Beyond the streams of all purposes.
            let stream = start.stream + (stream << 32);
            other.body.random = Random::new(start.seed, stream, start.episode);
            other.runner.reset();
        }
        let mut free = false;
        for _ in 0..TRIES {
            self.run_start(start.lines);
            if self.is_free() {
                free = true;
                break;
            }
        }
        if !free {
            self.place_anywhere();
        }
        if !self.others.is_empty() {
            self.others_look();
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

    /// The robot, by its place among all, for which these start lines leave no room most often.
    pub(super) fn blocked(&mut self, lines: usize) -> usize {
        let mut counts = vec![0_usize; self.robots().len()];
        for _ in 0..LOOKED {
            self.run_start(lines);
            self.doors_as_wanted();
            let robots = self.robots();
            let scene = self.body.scene();
            for (at, (&(p, radius), count)) in robots.iter().zip(&mut counts).enumerate() {
                // Of two in one place the later one is told.
                let mut before = robots.iter().take(at);
                let alone = before.all(|&(q, other)| apart((p, radius), (q, other)));
                *count += usize::from(!alone || !scene.is_free(p, radius));
            }
        }
        let most = counts.iter().copied().max();
        let found = counts.iter().position(|&count| Some(count) == most);
        found.unwrap_or_default()
    }

    fn run_start(&mut self, lines: usize) {
        for &(register, value) in &self.simulator.states {
            self.registers.set(register, value);
        }
        self.registers.set(Fixed::Touching.register(), 0.0);
        for &(_, register) in &self.simulator.layout.running() {
            self.registers.set(register, 0.0);
        }
        self.history.clear();
        self.body.tick();
        for other in &mut self.others {
            other.touching = 0.0;
            other.body.tick();
        }
        if let Some(scene) = &mut self.scene {
            // Nobody starts where a door may close.
            **scene = self.simulator.around.scene.clone();
            self.publish_scene();
        }
        let Some(steps) = self.simulator.compiled.starts.get(lines) else {
            self.place_anywhere();
            return;
        };
        for step in steps {
            match step {
                StartStep::Anywhere => self.place_anywhere(),
                StartStep::OtherAnywhere(other) => self.place_other_anywhere(*other),
                StartStep::Within(code) => {
                    let place = self.which_place(code);
                    let random = &mut self.body.random;
                    let pose = self.simulator.within(place, self.simulator.radius, random);
                    self.place(pose);
                }
                StartStep::OtherWithin(index, code) => {
                    let place = self.which_place(code);
                    if let Some(other) = self.others.get_mut(*index) {
                        let random = &mut other.body.random;
                        let pose = self.simulator.within(place, other.script.radius, random);
                        self.place_other(*index, pose);
                    }
                }
                StartStep::OtherPlace(other, code) => {
                    run(code, &mut self.registers, &mut self.body);
                    let id = Id::new(*other + 1);
                    let read = |coordinate| {
                        let register = self.simulator.layout.robot(id, coordinate);
                        self.registers.get(register)
                    };
                    let heading = Some(read(expr::Pose::Heading)).filter(|h| h.is_finite());
                    let position = [read(expr::Pose::X), read(expr::Pose::Y)];
                    let pose = Pose::new(position, heading.unwrap_or_default());
                    self.place_other(*other, pose);
                }
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

    /// Whether every robot is free where it stands, of what stands and of all others.
    fn is_free(&mut self) -> bool {
        self.doors_as_wanted();
        let robots = self.robots();
        let scene = self.body.scene();
        let free = robots.iter().all(|&(p, radius)| scene.is_free(p, radius));
        let alone = |(at, one): (usize, &(Point, f64))| {
            let mut others = robots.iter().skip(at + 1);
            others.all(|other| apart(*one, *other))
        };
        free && robots.iter().enumerate().all(alone)
    }

    /// Opens and closes the doors as the state wants them.
    fn doors_as_wanted(&mut self) {
        if self.scene.is_some() {
            let wanted = self.wanted_doors();
            let doors = &self.simulator.doors;
            if let Some(scene) = &mut self.scene
                && Door::swing(doors, wanted, scene, &[])
            {
                self.publish_scene();
            }
        }
    }

    /// The place of the number that this sets, if there is one.
    fn which_place(&mut self, code: &Code) -> Option<usize> {
        run(code, &mut self.registers, &mut self.body);
        let number = self.registers.get(WHICH.register());
        self.publish_pose();
        (number >= 0.0).then_some(number as usize)
    }

    fn place_other_anywhere(&mut self, index: usize) {
        let simulator = self.simulator;
        if let Some(other) = self.others.get_mut(index) {
            let random = &mut other.body.random;
            let position = simulator.anywhere(other.script.radius, random);
            let pose = Pose::new(position, any_heading(random));
            self.place_other(index, pose);
        }
    }

    /// Puts another robot somewhere.
    fn place_other(&mut self, index: usize, pose: Pose) {
        if let Some(other) = self.others.get_mut(index) {
            other.body.pose = pose;
        }
        self.forget_sights();
        self.meet();
        self.publish_others();
    }

    fn place_anywhere(&mut self) {
        let radius = self.simulator.radius;
        let position = self.simulator.anywhere(radius, &mut self.body.random);
        let heading = any_heading(&mut self.body.random);
        self.place(Pose::new(position, heading));
    }

    /// Puts the robot somewhere.
    fn place(&mut self, pose: Pose) {
        self.body.pose = pose;
        self.slack = 0.0;
        self.forget_sights();
        self.publish_pose();
        if !self.others.is_empty() {
            self.meet();
            self.publish_others();
        }
    }
}

/// Whether two bodies, each a centre with its radius, do not overlap.
fn apart((p, one): (Point, f64), (q, other): (Point, f64)) -> bool {
    let gap = minus(q, p);
    dot(gap, gap) >= (one + other) * (one + other)
}
