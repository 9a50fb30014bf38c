//! The two delivery programs, built by hand as the checker would build them.

use btc::geometry::{Point, Shape};
use btc::ir::expr::{Binary, Draw, Echo, Local, Pose, Temp, Unary};
use btc::ir::law::{Behavior, Block, Law, Stmt};
use btc::ir::program::{Effect, Event, Predicate, State, ValueKind};
use btc::ir::task::{History, RewardLine, StartLine, Task};
use btc::ir::tree::Status;
use btc::ir::world::{Contact, Drive, DriveKind, Robot, Sensor, SensorKind, Wall, World};
use btc::ir::{Expr, ExprId, Id, Pool, Program, Table};
use std::f64::consts::PI;

/// Arithmetic on a pool, short.
pub(crate) struct Maker<'a>(pub(crate) &'a mut Pool);

impl Maker<'_> {
    pub(crate) fn num(&mut self, value: f64) -> ExprId {
        self.0.num(value)
    }
    pub(crate) fn truth(&mut self, value: bool) -> ExprId {
        self.0.bool(value)
    }
    pub(crate) fn leaf(&mut self, expr: Expr) -> ExprId {
        self.0.leaf(expr)
    }
    pub(crate) fn x(&mut self) -> ExprId {
        self.leaf(Expr::Pose(Pose::X))
    }
    pub(crate) fn y(&mut self) -> ExprId {
        self.leaf(Expr::Pose(Pose::Y))
    }
    pub(crate) fn heading(&mut self) -> ExprId {
        self.leaf(Expr::Pose(Pose::Heading))
    }
    pub(crate) fn un(&mut self, op: Unary, a: ExprId) -> ExprId {
        self.0.unary(op, a)
    }
    pub(crate) fn bin(&mut self, op: Binary, a: ExprId, b: ExprId) -> ExprId {
        self.0.binary(op, a, b)
    }
    pub(crate) fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.bin(Binary::Add, a, b)
    }
    pub(crate) fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.bin(Binary::Sub, a, b)
    }
    pub(crate) fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.bin(Binary::Mul, a, b)
    }
    pub(crate) fn lt(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.bin(Binary::Lt, a, b)
    }
    pub(crate) fn le(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.bin(Binary::Le, a, b)
    }
    pub(crate) fn select(&mut self, c: ExprId, a: ExprId, b: ExprId) -> ExprId {
        self.0.select(c, a, b)
    }
    pub(crate) fn clamp(&mut self, a: ExprId, limit: f64) -> ExprId {
        let (low, high) = (self.num(-limit), self.num(limit));
        let a = self.bin(Binary::Max, a, low);
        self.bin(Binary::Min, a, high)
    }
    pub(crate) fn distance(&mut self, p: Point) -> ExprId {
        let (x, y) = self.toward(p);
        self.bin(Binary::Hypot, x, y)
    }
    pub(crate) fn direction(&mut self, p: Point) -> ExprId {
        let (x, y) = self.toward(p);
        self.bin(Binary::Atan2, y, x)
    }
    fn toward(&mut self, p: Point) -> (ExprId, ExprId) {
        let (px, py) = (self.num(p[0]), self.num(p[1]));
        let (x, y) = (self.x(), self.y());
        (self.sub(px, x), self.sub(py, y))
    }
    pub(crate) fn inside(&mut self, p: Point, radius: f64) -> ExprId {
        let (distance, radius) = (self.distance(p), self.num(radius));
        self.le(distance, radius)
    }
    pub(crate) fn visible(&mut self, p: Point) -> ExprId {
        let (x, y) = (self.num(p[0]), self.num(p[1]));
        self.leaf(Expr::Visible(x, y))
    }
    /// `wrap(course - heading)`
    pub(crate) fn error(&mut self, course: ExprId) -> ExprId {
        let heading = self.heading();
        let error = self.sub(course, heading);
        self.un(Unary::Wrap, error)
    }
    pub(crate) fn turn_to(&mut self, course: ExprId, max_turn: f64) -> ExprId {
        let (gain, error) = (self.num(4.0), self.error(course));
        let turn = self.mul(gain, error);
        self.clamp(turn, max_turn)
    }
    pub(crate) fn pace(&mut self, course: ExprId, max_speed: f64) -> ExprId {
        let error = self.error(course);
        let error = self.un(Unary::Abs, error);
        let (limit, zero, full) = (self.num(0.6), self.num(0.0), self.num(max_speed));
        let off = self.lt(limit, error);
        self.select(off, zero, full)
    }
    pub(crate) fn clear_of_walls(&mut self, course: ExprId) -> ExprId {
        let at = self.leaf(Expr::NearestWall(Echo::Direction));
        let distance = self.leaf(Expr::NearestWall(Echo::Distance));
        let off = self.sub(course, at);
        let off = self.un(Unary::Wrap, off);
        let (near, wide) = (self.num(0.25), self.num(95f64.to_radians()));
        let close = self.lt(distance, near);
        let size = self.un(Unary::Abs, off);
        let ahead = self.lt(size, wide);
        let avoid = self.0.and(close, ahead);
        let zero = self.num(0.0);
        let left = self.le(zero, off);
        let narrow = self.num(-95f64.to_radians());
        let side = self.select(left, wide, narrow);
        let aside = self.add(at, side);
        self.select(avoid, aside, course)
    }
}

pub(crate) fn drive(m: &mut Maker, speed: ExprId, turn: ExprId) -> Stmt {
    let strafe = m.num(0.0);
    Stmt::Drive {
        speed,
        strafe,
        turn,
    }
}

pub(crate) fn law(m: &mut Maker, requires: ExprId, succeed: ExprId, control: Vec<Stmt>) -> Law {
    Law {
        locals: Table::default(),
        requires,
        succeed,
        fail: m.truth(false),
        control: Block(control),
    }
}

fn goto(m: &mut Maker, p: Point, radius: f64, limits: [f64; 2]) -> Law {
    let requires = m.visible(p);
    let succeed = m.inside(p, radius);
    let direction = m.direction(p);
    let course = m.clear_of_walls(direction);
    let speed = m.pace(course, limits[0]);
    let turn = m.turn_to(course, limits[1]);
    let drive = drive(m, speed, turn);
    law(m, requires, succeed, vec![drive])
}

fn dock(m: &mut Maker, p: Point, facing: f64) -> Law {
    let requires = m.inside(p, 0.25);
    let facing = m.num(facing);
    let error = m.error(facing);
    let size = m.un(Unary::Abs, error);
    let small = m.num(0.1);
    let succeed = m.lt(size, small);
    let turn = m.turn_to(facing, 2.0);
    let still = m.num(0.0);
    let drive = drive(m, still, turn);
    law(m, requires, succeed, vec![drive])
}

fn follow_wall(m: &mut Maker, temps: &mut Table<Temp>) -> Law {
    let zero = m.num(0.0);
    let mut locals = Table::default();
    let hand_id = locals.push(Local {
        name: "hand".into(),
        initial: zero,
    });
    let sensor = |m: &mut Maker, i: usize, echo| m.leaf(Expr::Sensor(Id::new(i), echo));
    let hand = m.leaf(Expr::Local(hand_id));
    let (left, right) = (sensor(m, 0, Echo::Distance), sensor(m, 1, Echo::Distance));
    let bearing = |m: &mut Maker, i: usize| {
        let direction = sensor(m, i, Echo::Direction);
        m.error(direction)
    };
    let (left_at, right_at) = (bearing(m, 0), bearing(m, 1));
    let none = m.bin(Binary::Eq, hand, zero);
    let nearest = m.bin(Binary::Min, left, right);
    let catch = m.num(0.5);
    let met = m.le(nearest, catch);
    let met = m.0.and(none, met);
    let (one, minus_one) = (m.num(1.0), m.num(-1.0));
    let lefter = m.le(left, right);
    let side = m.select(lefter, one, minus_one);
    let is_left = m.le(zero, hand);
    let far = m.select(is_left, left, right);
    let at = m.select(is_left, left_at, right_at);
    let far_id = temps.push(Temp { name: "far".into() });
    let at_id = temps.push(Temp { name: "at".into() });
    let (far_now, at_now) = (m.leaf(Expr::Temp(far_id)), m.leaf(Expr::Temp(at_id)));
    let lose = m.num(0.9);
    let some = m.bin(Binary::Ne, hand, zero);
    let lost = m.lt(lose, far_now);
    let lost = m.0.and(some, lost);
    let full = m.num(0.5);
    let touching = m.leaf(Expr::Touching);
    let away = m.num(-2.0);
    let away = m.mul(hand, away);

    let quarter = m.num(PI / 2.0);
    let along = m.mul(hand, quarter);
    let error = m.sub(at_now, along);
    let gap = m.num(0.35);
    let beyond = m.sub(far_now, gap);
    let beyond = m.clamp(beyond, 0.25);
    let gain = m.num(2.5);
    let pull = m.mul(hand, gain);
    let pull = m.mul(pull, beyond);
    let bend = m.add(error, pull);
    let three = m.num(3.0);
    let bend = m.mul(three, bend);
    let bend = m.clamp(bend, 2.5);
    let cos = m.un(Unary::Cos, error);
    let least = m.num(0.15);
    let cos = m.bin(Binary::Max, cos, least);
    let size = m.un(Unary::Abs, bend);
    let ten = m.num(10.0);
    let part = m.bin(Binary::Div, size, ten);
    let slow = m.sub(one, part);
    let speed = m.bin(Binary::Min, cos, slow);
    let speed = m.mul(full, speed);

    let straight = drive(m, full, zero);
    let back = drive(m, zero, away);
    let follow = drive(m, speed, bend);
    let control = vec![
        Stmt::If(
            met,
            Block(vec![Stmt::SetLocal(hand_id, side)]),
            Block::default(),
        ),
        Stmt::Let(far_id, far),
        Stmt::Let(at_id, at),
        Stmt::If(
            lost,
            Block(vec![Stmt::SetLocal(hand_id, zero)]),
            Block::default(),
        ),
        Stmt::If(
            none,
            Block(vec![straight]),
            Block(vec![Stmt::If(
                touching,
                Block(vec![back]),
                Block(vec![follow]),
            )]),
        ),
    ];
    let (always, never) = (m.truth(true), m.truth(false));
    let mut law = law(m, always, never, control);
    law.locals = locals;
    law
}

fn wander(m: &mut Maker) -> Law {
    let mut locals = Table::default();
    let (low, high) = (m.num(-PI), m.num(PI));
    let course = m.0.draw(Draw::Uniform(low, high));
    let course_id = locals.push(Local {
        name: "course".into(),
        initial: course,
    });
    let (half, three_halves) = (m.num(0.5), m.num(1.5));
    let part = m.0.draw(Draw::Uniform(half, three_halves));
    let leg = m.num(1.5);
    let rest = m.mul(leg, part);
    let rest_id = locals.push(Local {
        name: "rest".into(),
        initial: rest,
    });
    let course = m.leaf(Expr::Local(course_id));
    let rest = m.leaf(Expr::Local(rest_id));
    let zero = m.num(0.0);
    let done = m.le(rest, zero);
    let touching = m.leaf(Expr::Touching);
    let succeed = m.0.or(done, touching);
    let speed = m.pace(course, 0.5);
    let turn = m.turn_to(course, 2.5);
    let tick = m.num(0.1);
    let gone = m.mul(speed, tick);
    let left = m.sub(rest, gone);
    let drive = drive(m, speed, turn);
    let always = m.truth(true);
    let mut law = law(
        m,
        always,
        succeed,
        vec![drive, Stmt::SetLocal(rest_id, left)],
    );
    law.locals = locals;
    law
}

/// Small delivery: four behaviours, two predicates. Behaviours: goto(A), goto(B), goto(C), dock(C).
pub(crate) fn small() -> (Program, Id<Task>) {
    let world = World {
        name: "warehouse".into(),
        tick: 0.1,
        arena: Shape::Rect {
            min: [0.0, 0.0],
            max: [6.0, 4.0],
        },
        walls: Table::default(),
        places: Table::default(),
        robot: robot(0.4, 2.0, 0.0, Table::default()),
    };
    let places = [([0.6, 2.0], 0.15), ([5.4, 2.0], 0.15), ([3.0, 0.3], 0.2)];
    delivery(world, places, -PI / 2.0, false)
}

/// Large delivery: a barrier, two scanners, six behaviours, five predicates. Behaviours: the four of the small one,
/// `follow_wall`, `wander`.
pub(crate) fn large() -> (Program, Id<Task>) {
    let barrier = Wall {
        name: "barrier".into(),
        shape: Shape::Polyline(vec![[2.6, 0.95], [2.6, 2.55], [1.5, 2.55]]),
    };
    let scanner = |name: &str, from: f64, to: f64| Sensor {
        name: name.into(),
        kind: SensorKind::Scanner {
            from,
            to,
            range: 3.0,
        },
        noise: 0.005,
    };
    let sensors = [scanner("left", 0.0, PI), scanner("right", -PI, 0.0)];
    let world = World {
        name: "warehouse".into(),
        tick: 0.1,
        arena: Shape::Rect {
            min: [0.0, 0.0],
            max: [6.0, 4.0],
        },
        walls: [barrier].into_iter().collect(),
        places: Table::default(),
        robot: robot(0.5, 2.5, 0.2, sensors.into_iter().collect()),
    };
    let places = [
        ([1.15, 2.35], 0.15),
        ([4.45, 1.95], 0.15),
        ([5.65, 2.5], 0.15),
    ];
    delivery(world, places, 0.0, true)
}

fn robot(max_speed: f64, max_turn: f64, turn_noise: f64, sensors: Table<Sensor>) -> Robot {
    Robot {
        name: "create2".into(),
        radius: 0.17,
        drive: Drive {
            kind: DriveKind::Differential,
            max_speed,
            max_turn,
            speed_noise: 0.0,
            turn_noise,
        },
        contact: Contact::Stop,
        sensors,
    }
}

fn delivery(
    world: World,
    places: [(Point, f64); 3],
    facing: f64,
    large: bool,
) -> (Program, Id<Task>) {
    let mut program = Program::default();
    let limits = [world.robot.drive.max_speed, world.robot.drive.max_turn];
    let mut m = Maker(&mut program.pool);
    let mut add = |name: &str, law: Law| {
        program.behaviors.push(Behavior {
            name: name.into(),
            law: Some(law),
        })
    };
    let [a, b, c] = places;
    let goto_a = add("goto(A)", goto(&mut m, a.0, a.1, limits));
    let goto_b = add("goto(B)", goto(&mut m, b.0, b.1, limits));
    let goto_c = add("goto(C)", goto(&mut m, c.0, c.1, limits));
    let dock_c = add("dock(C)", dock(&mut m, c.0, facing));
    let mut choose = vec![goto_a, goto_b, goto_c, dock_c];
    if large {
        let follow = follow_wall(&mut m, &mut program.temps);
        choose.push(add("follow_wall", follow));
        choose.push(add("wander", wander(&mut m)));
    }

    let (no, yes, full) = (m.truth(false), m.truth(true), m.num(1.0));
    let carrying = program.states.push(State {
        name: "carrying".into(),
        kind: ValueKind::Bool,
        initial: no,
    });
    let battery = program.states.push(State {
        name: "battery".into(),
        kind: ValueKind::Quantity,
        initial: full,
    });
    let is_carrying = m.leaf(Expr::State(carrying));
    let charge = m.leaf(Expr::State(battery));
    let ended = |m: &mut Maker, id| m.leaf(Expr::Ended(id, Status::Success));
    let empty = m.0.not(is_carrying);
    let at_a = ended(&mut m, goto_a);
    let pickup = m.0.and(at_a, empty);
    let at_b = ended(&mut m, goto_b);
    let dropoff = m.0.and(at_b, is_carrying);
    let docked = ended(&mut m, dock_c);
    let zero = m.num(0.0);
    let dead = m.le(charge, zero);
    let mut event = |m: &mut Maker, name: &str, when| {
        let id = program.events.push(Event {
            name: name.into(),
            when,
        });
        m.leaf(Expr::Event(id))
    };
    let pickup = event(&mut m, "pickup", pickup);
    let dropoff = event(&mut m, "dropoff", dropoff);
    let docked = event(&mut m, "docked", docked);
    let dead = event(&mut m, "dead", dead);
    let drain = m.num(0.001);
    let drained = m.sub(charge, drain);
    program.each_tick = Block(vec![Stmt::SetState(battery, drained)]);
    program.effects = [
        (pickup, carrying, yes),
        (dropoff, carrying, no),
        (docked, battery, full),
    ]
    .into_iter()
    .map(|(on, state, value)| Effect {
        on,
        block: Block(vec![Stmt::SetState(state, value)]),
    })
    .collect();

    let low = m.num(0.25);
    let low = m.le(charge, low);
    let mut observe = Vec::new();
    let mut predicate = |name: &str, when| {
        observe.push(program.predicates.push(Predicate {
            name: name.into(),
            when: Some(when),
        }));
    };
    predicate("carrying_package", is_carrying);
    predicate("battery_low", low);
    if large {
        for (name, place) in ["vis(A)", "vis(B)", "vis(C)"].iter().zip(places) {
            let visible = m.visible(place.0);
            predicate(name, visible);
        }
    }

    let half = m.num(0.5);
    let carry = m.0.draw(Draw::Chance(half));
    let (least, most) = (m.num(0.3), m.num(1.0));
    let charged = m.0.draw(Draw::Uniform(least, most));
    let codes = (m.num(0.0), m.num(2.0));
    let history = m.select(is_carrying, codes.0, codes.1);
    let line = |name: &str, event, value| RewardLine {
        name: name.into(),
        event,
        value,
    };
    let values = [m.num(-5.0), m.num(1.0), m.num(2.0), m.num(-0.1)];
    let task = program.tasks.push(Task {
        name: "delivery".into(),
        observe,
        choose,
        history: History {
            window: 1,
            success: true,
            failure: false,
        },
        patience: large.then_some(600),
        start: vec![
            StartLine::Anywhere,
            StartLine::State(carrying, carry),
            StartLine::State(battery, charged),
            StartLine::History(history),
        ],
        end_on: vec![dead],
        end_after: 5000,
        reward: vec![
            line("dead", dead, values[0]),
            line("pickup", pickup, values[1]),
            line("dropoff", dropoff, values[2]),
        ],
        otherwise: values[3],
    });
    program.world = Some(world);
    (program, task)
}
