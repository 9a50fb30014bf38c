//! The checked program as text, for reading and for snapshots.

use crate::ir::expr::{Draw, Expr, ExprId};
use crate::ir::input::InputKind;
use crate::ir::law::{Block, Law, Stmt};
use crate::ir::program::{Program, State, ValueKind};
use crate::ir::task::{Discount, Objective, Placing, StartLine, TreeRef};
use crate::ir::tree::Tree;
use crate::ir::{Id, name};
use std::fmt::Write;

/// The program, a definition a line, expressions written out.
pub fn program(program: &Program) -> String {
    let mut out = Out {
        program,
        text: String::new(),
    };
    out.world();
    out.inputs();
    out.states();
    out.behaviors();
    out.tasks();
    out.trees();
    out.tunables();
    out.text
}

struct Out<'p> {
    program: &'p Program,
    text: String,
}

impl Out<'_> {
    fn line(&mut self, depth: usize, line: impl AsRef<str>) {
        for _ in 0..depth {
            self.text.push_str("    ");
        }
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }

    fn world(&mut self) {
        let Some(world) = &self.program.world else {
            return;
        };
        self.line(0, format!("world {} tick {} s", world.name, world.tick));
        self.line(1, format!("arena {:?}", world.arena));
        for (id, wall) in world.walls.iter() {
            let when = wall.when.map(|when| format!(" when {}", self.expr(when)));
            let when = when.unwrap_or_default();
            self.line(
                1,
                format!("wall {id:?} {} {:?}{when}", wall.name, wall.shape),
            );
        }
        for (id, place) in world.places.iter() {
            let facing = place
                .facing
                .map_or(String::new(), |a| format!(" facing {a}"));
            self.line(
                1,
                format!("place {id:?} {} {:?}{facing}", place.name, place.shape),
            );
        }
        for robot in world.robots() {
            self.line(
                1,
                format!(
                    "robot {} radius {} {:?} {:?}",
                    robot.name, robot.radius, robot.drive, robot.contact
                ),
            );
            for (id, sensor) in robot.sensors.iter() {
                self.line(
                    2,
                    format!(
                        "sensor {id:?} {} {:?} noise {}",
                        sensor.name, sensor.kind, sensor.noise
                    ),
                );
            }
        }
    }

    fn tunables(&mut self) {
        for (id, tunable) in self.program.tunables.iter() {
            let [value, low, high] =
                [tunable.value, tunable.low, tunable.high].map(|number| tunable.written(number));
            self.line(
                0,
                format!("tune {id:?} {} = {value} in {low} .. {high}", tunable.name),
            );
        }
    }

    fn inputs(&mut self) {
        for (id, input) in self.program.inputs.iter() {
            let kind = match &input.kind {
                InputKind::Number { ratio: true, .. } => "ratio".to_owned(),
                InputKind::Number { dim, .. } => dim.written(),
                InputKind::Category(values) => format!("{{{}}}", name::list(values)),
            };
            self.line(0, format!("input {id:?} {}: {kind}", input.name));
        }
    }

    fn states(&mut self) {
        for (id, state) in self.program.states.iter() {
            let kind = match &state.kind {
                ValueKind::Bool => "bool".to_owned(),
                ValueKind::Quantity => "quantity".to_owned(),
                ValueKind::Enum(variants) => format!("enum {{{}}}", name::list(variants)),
            };
            let initial = self.expr(state.initial);
            self.line(
                0,
                format!("state {id:?} {}: {kind} = {initial}", state.name),
            );
        }
        for (id, event) in self.program.events.iter() {
            let when = self.expr(event.when);
            self.line(0, format!("event {id:?} {} = {when}", event.name));
        }
        if !self.program.each_tick.0.is_empty() {
            self.line(0, "each tick");
            self.block(&self.program.each_tick, 1);
        }
        for effect in &self.program.effects {
            let on = self.expr(effect.on);
            self.line(0, format!("on {on}"));
            self.block(&effect.block, 1);
        }
        for (id, predicate) in self.program.predicates.iter() {
            let when = predicate
                .when
                .map_or("declared".to_owned(), |id| self.expr(id));
            self.line(0, format!("predicate {id:?} {} = {when}", predicate.name));
        }
    }

    fn behaviors(&mut self) {
        for (id, behavior) in self.program.behaviors.iter() {
            self.line(0, format!("behavior {id:?} {}", behavior.name));
            match &behavior.law {
                Some(law) => self.law(law),
                None => self.line(1, "declared"),
            }
        }
    }

    fn law(&mut self, law: &Law) {
        for (id, local) in law.locals.iter() {
            let initial = self.expr(local.initial);
            self.line(1, format!("local {id:?} {} = {initial}", local.name));
        }
        for (word, region) in [
            ("requires", law.requires),
            ("succeed", law.succeed),
            ("fail", law.fail),
        ] {
            let region = self.expr(region);
            self.line(1, format!("{word} {region}"));
        }
        self.line(1, "control");
        self.block(&law.control, 2);
    }

    fn block(&mut self, block: &Block, depth: usize) {
        for stmt in &block.0 {
            match stmt {
                Stmt::Let(temp, value) => {
                    let value = self.expr(*value);
                    let name = &self.program.temps[*temp].name;
                    self.line(depth, format!("let t{} = {value}  // {name}", temp.index()));
                }
                Stmt::SetState(id, value) => {
                    let value = self.expr(*value);
                    let name = &self.program.states[*id].name;
                    self.line(depth, format!("{name} = {value}"));
                }
                Stmt::SetLocal(id, value) => {
                    let value = self.expr(*value);
                    self.line(depth, format!("local{id:?} = {value}"));
                }
                Stmt::If(condition, then, otherwise) => {
                    let condition = self.expr(*condition);
                    self.line(depth, format!("if {condition}"));
                    self.block(then, depth + 1);
                    if !otherwise.0.is_empty() {
                        self.line(depth, "else");
                        self.block(otherwise, depth + 1);
                    }
                }
                Stmt::Drive {
                    speed,
                    strafe,
                    turn,
                } => {
                    let (speed, turn) = (self.expr(*speed), self.expr(*turn));
                    let strafe = self.expr(*strafe);
                    self.line(
                        depth,
                        format!("drive speed {speed} strafe {strafe} turn {turn}"),
                    );
                }
            }
        }
    }

    fn tasks(&mut self) {
        let program = self.program;
        for (id, task) in program.tasks.iter() {
            self.line(0, format!("task {id:?} {}", task.name));
            let observe = task.observe.iter().map(|id| &program.predicates[*id].name);
            let choose = task.choose.iter().map(|id| &program.behaviors[*id].name);
            self.line(1, format!("observe {}", name::list(observe)));
            self.line(1, format!("choose {}", name::list(choose)));
            self.line(
                1,
                format!("{:?} patience {:?}", task.history, task.patience),
            );
            self.start(&task.start);
            for id in &task.end_on {
                let event = self.expr(*id);
                self.line(1, format!("end on {event}"));
            }
            self.line(1, format!("end after {} ticks", task.end_after));
            for line in &task.reward {
                let (event, value) = (self.expr(line.event), self.expr(line.value));
                self.line(1, format!("reward {event}: {value}  // {}", line.name));
            }
            for price in &task.prices {
                let (during, value) = (self.expr(price.during), self.expr(price.per_second));
                let name = &price.name;
                self.line(
                    1,
                    format!("reward while {during}, per second: {value}  // {name}"),
                );
            }
            let otherwise = self.expr(task.otherwise);
            self.line(1, format!("reward otherwise: {otherwise}"));
        }
        for learner in program.learners.values() {
            self.line(
                0,
                format!(
                    "learner {} for {}",
                    learner.name, program.tasks[learner.task].name
                ),
            );
            let (rate, explore) = (self.expr(learner.rate), self.expr(learner.explore));
            let objective = match learner.objective {
                Objective::Discounted(Discount::PerDecision(factor)) => {
                    format!("discount {factor} per decision")
                }
                Objective::Discounted(Discount::PerTime(factor, span)) => {
                    format!("discount {factor} per {span} s")
                }
                Objective::Average(span) => format!("average per {span} s"),
            };
            self.line(
                1,
                format!(
                    "{:?} episodes {} of {} ticks, rate {rate}, explore {explore}, {objective}, initial {}, \
                     dwell {}, seed {}",
                    learner.method,
                    learner.episodes,
                    learner.episode_ticks,
                    learner.initial,
                    learner.dwell,
                    learner.seed
                ),
            );
            if let Some(unseen) = learner.unseen {
                self.line(1, format!("unseen {}", program.behaviors[unseen].name));
            }
            self.start(&learner.start);
        }
    }

    fn start(&mut self, lines: &[StartLine]) {
        for line in lines {
            let text = match line {
                StartLine::Anywhere(within) => format!("start {}", self.anywhere(*within)),
                StartLine::Position(x, y) => {
                    format!("start position ({}, {})", self.expr(*x), self.expr(*y))
                }
                StartLine::Heading(a) => format!("start heading {}", self.expr(*a)),
                StartLine::Other(robot, placing) => {
                    let what = match placing {
                        Placing::Anywhere(within) => self.anywhere(*within),
                        Placing::Position(x, y) => {
                            format!("position ({}, {})", self.expr(*x), self.expr(*y))
                        }
                        Placing::Heading(a) => format!("heading {}", self.expr(*a)),
                    };
                    format!("start of robot {} {what}", robot.index())
                }
                StartLine::State(parts) => {
                    let name = |id: &Id<State>| self.program.states[*id].name.to_string();
                    let set: Vec<String> = parts
                        .iter()
                        .map(|(id, value)| format!("{} = {}", name(id), self.expr(*value)))
                        .collect();
                    format!("start {}", set.join(", "))
                }
                StartLine::Member(of, block) => {
                    self.line(1, format!("start {of}"));
                    self.block(block, 2);
                    continue;
                }
                StartLine::History(code) => format!("start history {}", self.expr(*code)),
            };
            self.line(1, text);
        }
    }

    fn anywhere(&self, within: Option<ExprId>) -> String {
        match within {
            None => "pose anywhere".to_owned(),
            Some(place) => format!("pose anywhere in place {}", self.expr(place)),
        }
    }

    fn trees(&mut self) {
        let program = self.program;
        for (id, tree) in program.trees.iter() {
            let plain = Tree {
                docs: Vec::new(),
                ..tree.clone()
            };
            let text = super::bt::tree(program, &plain);
            self.line(0, format!("tree {id:?}"));
            for line in text.lines() {
                self.line(1, line);
            }
        }
        for claim in &program.claims {
            let tree = match claim.tree {
                TreeRef::Tree(id) => &program.trees[id].name,
                TreeRef::Learned(id) => &program.learners[id].name,
            };
            self.line(0, format!("claim of {tree}: {}", claim.text));
        }
        for test in &program.tests {
            let lines = test.lines.len();
            let (title, tree) = (&test.title, &test.tree);
            self.line(0, format!("test {title:?} of {tree}, lines: {lines}"));
        }
    }

    fn expr(&self, id: ExprId) -> String {
        let program = self.program;
        let sub = |id| self.expr(id);
        match program.pool.get(id) {
            Expr::Num(value) => format!("{value}"),
            Expr::Bool(value) => format!("{value}"),
            Expr::State(id) => program.states[id].name.to_string(),
            Expr::Input(id) => program.inputs[id].name.to_string(),
            Expr::Local(id) => format!("local{id:?}"),
            Expr::Temp(id) => format!("t{}", id.index()),
            Expr::Pose(pose) => lower(&pose),
            Expr::Robot(id, pose) => format!("robot{id:?}.{}", lower(&pose)),
            Expr::Touching => "touching".to_owned(),
            Expr::Elapsed => "elapsed".to_owned(),
            Expr::Visits => "visits".to_owned(),
            Expr::Progress => "progress".to_owned(),
            Expr::Visible(x, y) => format!("visible({}, {})", sub(x), sub(y)),
            Expr::NearestWall(echo) => format!("nearest_wall.{}", lower(&echo)),
            Expr::Wall(id, echo) => format!("wall{id:?}.{}", lower(&echo)),
            Expr::Sensor(id, echo) => format!("sensor{id:?}.{}", lower(&echo)),
            Expr::Inside(id) => format!("inside(place{id:?})"),
            Expr::Ended(id, status) => {
                format!("{}({})", status.name(), program.behaviors[id].name)
            }
            Expr::Event(id) => program.events[id].name.to_string(),
            Expr::Unary(op, a) => format!("{}({})", lower(&op), sub(a)),
            Expr::Binary(op, a, b) => format!("{}({}, {})", lower(&op), sub(a), sub(b)),
            Expr::Select(c, a, b) => format!("select({}, {}, {})", sub(c), sub(a), sub(b)),
            Expr::Draw(number, draw) => {
                let mut text = format!("draw{number}:");
                let _ = match draw {
                    Draw::Uniform(a, b) => write!(text, "uniform({}, {})", sub(a), sub(b)),
                    Draw::Normal(a, b) => write!(text, "normal({}, {})", sub(a), sub(b)),
                    Draw::Chance(p) => write!(text, "chance({})", sub(p)),
                    Draw::Pick(n) => write!(text, "pick({n})"),
                };
                text
            }
        }
    }
}

fn lower(value: &impl std::fmt::Debug) -> String {
    format!("{value:?}").to_lowercase()
}
