//! Register code does what the expressions and statements say: a second, naive reading of them is the oracle.

use btc::eval::{Compiler, Fixed, Host, Layout, Reading, compile, run};
use btc::geometry::Shape;
use btc::ir::expr::{Binary, Draw, Echo, Kind, Local, Pose, Temp, Unary};
use btc::ir::law::{Behavior, Block, Law, Stmt};
use btc::ir::program::{State, Stays, ValueKind};
use btc::ir::world::{Contact, Drive, DriveKind, Robot, Sensor, SensorKind, Wall, World};
use btc::ir::{Expr, ExprId, Id, Name, Program, Table};
use btc::random::Random;
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::PI;

const STATES: usize = 3;
const LOCALS: usize = 2;
/// How deep branches are nested.
const DEPTH: usize = 3;

/// A world that is only numbers: what it says is a function of what it is asked.
#[derive(Clone)]
struct Numbers {
    random: Random,
    atoms: u128,
}

impl Numbers {
    fn reading(source: u16) -> Reading {
        let n = f64::from(source);
        Reading {
            distance: 0.4 + n,
            toward: [1.0 - n, 0.5 * n - 0.7],
            seen: source.is_multiple_of(2),
        }
    }
}

impl Host for Numbers {
    fn visible(&mut self, x: f64, y: f64) -> bool {
        x < y
    }
    fn look(&mut self, source: u16, parts: &mut [f64; 4]) {
        *parts = Self::reading(source).parts();
    }
    fn inside(&mut self, place: u16) -> bool {
        place == 1
    }
    fn random(&mut self) -> &mut Random {
        &mut self.random
    }
    fn fire(&mut self, _: u16) {}
    fn atoms(&mut self) -> &mut u128 {
        &mut self.atoms
    }
}

/// Everything that code reads and writes, evaluated by recursion.
struct Naive<'a> {
    program: &'a Program,
    host: Numbers,
    states: [f64; STATES],
    locals: [f64; LOCALS],
    temps: BTreeMap<usize, f64>,
    draws: BTreeMap<ExprId, f64>,
    /// The draws that were made in the blocks at hand.
    drawn: Vec<ExprId>,
    drive: [f64; 3],
}

const POSE: [f64; 3] = [0.3, -1.2, 2.0];
const ELAPSED: f64 = 0.7;

impl Naive<'_> {
    fn eval(&mut self, id: ExprId) -> f64 {
        match self.program.pool[id] {
            Expr::Num(value) => value,
            Expr::Bool(value) => f64::from(value),
            Expr::State(id) => self.states[id.index()],
            Expr::Local(id) => self.locals[id.index()],
            Expr::Temp(id) => self.temps[&id.index()],
            Expr::Pose(pose) => POSE[pose as usize],
            Expr::Touching => 1.0,
            Expr::Elapsed => ELAPSED,
            Expr::Visible(x, y) => {
                let (x, y) = (self.eval(x), self.eval(y));
                f64::from(x < y)
            }
            Expr::NearestWall(echo) => Self::echo(0, echo),
            Expr::Sensor(id, echo) => Self::echo(1 + id.index(), echo),
            Expr::Wall(id, echo) => Self::echo(2 + id.index(), echo),
            Expr::Inside(id) => f64::from(id.index() == 1),
            Expr::Unary(op, a) => op.apply(self.eval(a)),
            Expr::Binary(op, a, b) => {
                let (a, b) = (self.eval(a), self.eval(b));
                op.apply(a, b)
            }
            Expr::Select(c, a, b) => {
                if self.eval(c) != 0.0 {
                    self.eval(a)
                } else {
                    self.eval(b)
                }
            }
            Expr::Draw(..) => self.draws[&id],
            other => unreachable!("{other:?}"),
        }
    }

    fn echo(source: usize, echo: Echo) -> f64 {
        let reading = Numbers::reading(source as u16);
        match echo {
            Echo::Distance => reading.distance,
            Echo::Direction => btc::math::atan2(reading.toward[1], reading.toward[0]),
            Echo::Seen => f64::from(reading.seen),
        }
    }

    /// Makes the draws of a statement that were not made before in its blocks, in the order of their numbers.
    fn draw(&mut self, expressions: &[ExprId]) {
        let mut found = BTreeMap::new();
        let mut open = expressions.to_vec();
        while let Some(id) = open.pop() {
            if let Expr::Draw(number, draw) = self.program.pool[id] {
                found.insert(number, (id, draw));
            }
            open.extend(self.program.pool.operands(id));
        }
        for (id, draw) in found.into_values() {
            if self.drawn.contains(&id) {
                continue;
            }
            self.drawn.push(id);
            let value = match draw {
                Draw::Uniform(a, b) => {
                    let (a, b) = (self.eval(a), self.eval(b));
                    self.host.random.uniform(a, b)
                }
                Draw::Normal(a, b) => {
                    let (a, b) = (self.eval(a), self.eval(b));
                    a + b * self.host.random.gaussian()
                }
                Draw::Chance(a) => {
                    let a = self.eval(a);
                    f64::from(self.host.random.chance(a))
                }
                Draw::Pick(n) => self.host.random.below(n.into()) as f64,
            };
            self.draws.insert(id, value);
        }
    }

    fn block(&mut self, block: &Block) {
        let outside = self.drawn.len();
        for statement in &block.0 {
            match statement {
                Stmt::Let(id, value) => {
                    self.draw(&[*value]);
                    let value = self.eval(*value);
                    self.temps.insert(id.index(), value);
                }
                Stmt::SetState(id, value) => {
                    self.draw(&[*value]);
                    self.states[id.index()] = self.eval(*value);
                }
                Stmt::SetLocal(id, value) => {
                    self.draw(&[*value]);
                    self.locals[id.index()] = self.eval(*value);
                }
                Stmt::If(condition, then, otherwise) => {
                    self.draw(&[*condition]);
                    if self.eval(*condition) != 0.0 {
                        self.block(then);
                    } else {
                        self.block(otherwise);
                    }
                }
                Stmt::Drive {
                    speed,
                    strafe,
                    turn,
                } => {
                    self.draw(&[*speed, *strafe, *turn]);
                    self.drive = [*speed, *strafe, *turn].map(|id| self.eval(id));
                }
            }
        }
        self.drawn.truncate(outside);
    }

    fn law(&mut self, law: &Law) -> u16 {
        if self.eval(law.requires) == 0.0 {
            1
        } else if self.eval(law.succeed) != 0.0 {
            0
        } else if self.eval(law.fail) != 0.0 {
            1
        } else {
            self.block(&law.control);
            2
        }
    }
}

/// Makes random expressions and statements over a program.
struct Inventor {
    random: Random,
    program: Program,
    /// Numbers and truth values that expressions may share; those without draws.
    numbers: Vec<ExprId>,
    truths: Vec<ExprId>,
}

impl Inventor {
    fn pick(&mut self, n: usize) -> usize {
        self.random.below(n as u64) as usize
    }

    fn number(&mut self, depth: usize, draws: bool) -> ExprId {
        if depth == 0 || self.pick(5) == 0 {
            let i = self.pick(self.numbers.len());
            return self.numbers[i];
        }
        let not = |op: &Unary| *op != Unary::Not;
        let unary: Vec<Unary> = Unary::ALL.iter().copied().filter(not).collect();
        let truth = |op: &Binary| op.gives() == Kind::Truth;
        let binary: Vec<Binary> = Binary::ALL
            .iter()
            .copied()
            .filter(|op| !truth(op))
            .collect();
        let id = match self.pick(if draws { 9 } else { 8 }) {
            0 | 1 => {
                let op = unary[self.pick(unary.len())];
                let a = self.number(depth - 1, draws);
                self.program.pool.unary(op, a)
            }
            2 | 3 => {
                let op = binary[self.pick(binary.len())];
                let a = self.number(depth - 1, draws);
                let b = self.number(depth - 1, draws);
                self.program.pool.binary(op, a, b)
            }
            4 => {
                let limit = self.number(1, false);
                let a = self.number(depth - 1, draws);
                let low = self.program.pool.unary(Unary::Neg, limit);
                let a = self.program.pool.binary(Binary::Max, a, low);
                self.program.pool.binary(Binary::Min, a, limit)
            }
            5 => {
                let a = self.number(depth - 1, draws);
                let b = self.number(depth - 1, draws);
                let off = self.program.pool.binary(Binary::Sub, a, b);
                self.program.pool.unary(Unary::Wrap, off)
            }
            6 | 7 => {
                let c = self.truth(depth - 1, draws);
                let a = self.number(depth - 1, draws);
                let b = self.number(depth - 1, draws);
                self.program.pool.select(c, a, b)
            }
            _ => {
                let a = self.number(1, false);
                let b = self.number(1, false);
                let draw = match self.pick(4) {
                    0 => Draw::Uniform(a, b),
                    1 => Draw::Normal(a, b),
                    2 => Draw::Chance(a),
                    _ => Draw::Pick(3),
                };
                return self.program.pool.draw(draw);
            }
        };
        if !draws {
            self.numbers.push(id);
        }
        id
    }

    fn truth(&mut self, depth: usize, draws: bool) -> ExprId {
        if depth == 0 {
            let i = self.pick(self.truths.len());
            return self.truths[i];
        }
        let id = match self.pick(8) {
            0 => {
                let a = self.truth(depth - 1, draws);
                self.program.pool.not(a)
            }
            1 | 2 => {
                let op = [Binary::And, Binary::Or][self.pick(2)];
                let a = self.truth(depth - 1, draws);
                let b = self.truth(depth - 1, draws);
                self.program.pool.binary(op, a, b)
            }
            3 => {
                let x = self.number(depth - 1, draws);
                let y = self.number(depth - 1, draws);
                let distance = self.program.pool.binary(Binary::Hypot, x, y);
                let radius = self.random.uniform(-0.5, 3.0);
                let radius = self.program.pool.num(radius);
                let op = [Binary::Le, Binary::Lt][self.pick(2)];
                match self.pick(2) {
                    0 => self.program.pool.binary(op, distance, radius),
                    _ => self.program.pool.binary(op, radius, distance),
                }
            }
            4 => {
                let x = self.number(depth - 1, draws);
                let y = self.number(depth - 1, draws);
                self.program.pool.leaf(Expr::Visible(x, y))
            }
            5 => {
                let i = self.pick(self.truths.len());
                return self.truths[i];
            }
            _ => {
                let op = [Binary::Eq, Binary::Ne, Binary::Lt, Binary::Le][self.pick(4)];
                let a = self.number(depth - 1, draws);
                let b = self.number(depth - 1, draws);
                self.program.pool.binary(op, a, b)
            }
        };
        if !draws {
            self.truths.push(id);
        }
        id
    }

    fn block(&mut self, depth: usize) -> Block {
        let scope = (self.numbers.clone(), self.truths.clone());
        let mut statements = Vec::new();
        for _ in 0..self.pick(5) + 1 {
            let draws = self.pick(3) == 0;
            statements.push(match self.pick(8) {
                0..=2 => {
                    let value = self.number(3, draws);
                    let name = Name::default();
                    let temp = self.program.temps.push(Temp {
                        name,
                        stays: Stays::ANY,
                    });
                    let read = self.program.pool.leaf(Expr::Temp(temp));
                    self.numbers.extend([read; 4]);
                    Stmt::Let(temp, value)
                }
                3 | 4 => Stmt::SetState(Id::new(self.pick(STATES)), self.number(3, draws)),
                5 => Stmt::SetLocal(Id::new(self.pick(LOCALS)), self.number(3, draws)),
                6 if depth > 0 => Stmt::If(
                    self.truth(3, draws),
                    self.block(depth - 1),
                    self.block(depth - 1),
                ),
                _ => Stmt::SetLocal(Id::new(0), self.number(2, draws)),
            });
        }
        // At most one drive on each path: none, one here, or one in the branch at the end.
        if depth == DEPTH {
            let mut branch = || match self.pick(3) {
                0 => Vec::new(),
                _ => vec![self.drive()],
            };
            let (then, otherwise) = (Block(branch()), Block(branch()));
            statements.push(match self.pick(3) {
                0 => self.drive(),
                _ => Stmt::If(self.truth(3, true), then, otherwise),
            });
        }
        // Names of a block are not read after it.
        (self.numbers, self.truths) = scope;
        Block(statements)
    }

    fn drive(&mut self) -> Stmt {
        let draws = self.pick(2) == 0;
        Stmt::Drive {
            speed: self.number(3, draws),
            strafe: self.number(3, draws),
            turn: self.number(3, draws),
        }
    }
}

fn invent(seed: u64) -> (Program, Law) {
    let mut program = Program::default();
    let zero = program.pool.num(0.0);
    for _ in 0..STATES {
        program.states.push(State {
            name: Name::default(),
            kind: ValueKind::Quantity,
            initial: zero,
            stays: Stays::ANY,
        });
    }
    program.world = Some(World {
        name: Name::default(),
        tick: 0.1,
        arena: Shape::Polyline(vec![]),
        walls: [Wall {
            name: Name::default(),
            shape: Shape::Polyline(vec![]),
            when: None,
        }]
        .into_iter()
        .collect(),
        places: Table::default(),
        others: Table::default(),
        robot: Robot {
            name: Name::default(),
            radius: 0.1,
            drive: Drive {
                kind: DriveKind::Holonomic,
                max_speed: 1.0,
                max_turn: 1.0,
                speed_noise: 0.0,
                turn_noise: 0.0,
            },
            contact: Contact::Stop,
            sensors: [Sensor {
                name: Name::default(),
                kind: SensorKind::RangeFinder {
                    at: 0.0,
                    range: 1.0,
                },
                noise: 0.0,
            }]
            .into_iter()
            .collect(),
        },
    });
    let numbers = [
        Expr::Num(0.0),
        Expr::Num(1.0),
        Expr::Num(-0.6),
        Expr::Num(2.5),
        Expr::State(Id::new(0)),
        Expr::State(Id::new(1)),
        Expr::State(Id::new(2)),
        Expr::Local(Id::new(0)),
        Expr::Local(Id::new(1)),
        Expr::Pose(Pose::X),
        Expr::Pose(Pose::Heading),
        Expr::Elapsed,
        Expr::NearestWall(Echo::Distance),
        Expr::NearestWall(Echo::Direction),
        Expr::Sensor(Id::new(0), Echo::Direction),
        Expr::Wall(Id::new(0), Echo::Distance),
    ]
    .map(|expr| program.pool.leaf(expr))
    .to_vec();
    let truths = [
        Expr::Bool(true),
        Expr::Touching,
        Expr::Inside(Id::new(0)),
        Expr::Inside(Id::new(1)),
        Expr::Sensor(Id::new(0), Echo::Seen),
        Expr::State(Id::new(0)),
    ]
    .map(|expr| program.pool.leaf(expr))
    .to_vec();
    let mut inventor = Inventor {
        random: Random::new(seed, 0, 0),
        program,
        numbers,
        truths,
    };
    let mut locals = Table::default();
    for _ in 0..LOCALS {
        locals.push(Local {
            name: Name::default(),
            initial: zero,
            stays: Stays::ANY,
        });
    }
    let law = Law {
        locals,
        requires: inventor.truth(2, false),
        succeed: inventor.truth(2, false),
        fail: inventor.truth(2, false),
        control: inventor.block(DEPTH),
    };
    let mut program = inventor.program;
    program.behaviors.push(Behavior {
        name: Name::default(),
        law: Some(law.clone()),
    });
    (program, law)
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan() || a == b
}

/// What runs code.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Interpreter,
    Processor,
}

/// Runs a law or only its control both ways, from the same values.
fn compare(seed: u64, whole: bool, by: By) {
    let (program, law) = invent(seed);
    let behavior = Id::new(0);
    let mut layout = Layout::new(&program).unwrap();
    let mut compiler = Compiler::new(&program.pool, &mut layout, Some(behavior));
    if whole {
        compiler.law(&law).unwrap();
    } else {
        compiler.block(&law.control).unwrap();
    }
    let code = compiler.finish().unwrap();
    if by == By::Processor {
        assert_eq!(compile([&code].into_iter()), cfg!(feature = "native"));
    }

    for trial in 0..4 {
        let mut random = Random::new(seed, 1, trial);
        let mut value = || match random.below(4) {
            0 => 0.0,
            1 => f64::from(random.below(3) as u32) - 1.0,
            _ => random.uniform(-3.0, 3.0),
        };
        let mut naive = Naive {
            program: &program,
            host: Numbers {
                random: Random::new(seed, 2, trial),
                atoms: 0,
            },
            states: [value(), value(), value()],
            locals: [value(), value()],
            temps: BTreeMap::new(),
            draws: BTreeMap::new(),
            drawn: Vec::new(),
            drive: [0.0; 3],
        };
        let mut host = naive.host.clone();
        let mut registers = layout.registers();
        for (fixed, value) in [Fixed::X, Fixed::Y, Fixed::Heading].into_iter().zip(POSE) {
            registers.set(fixed.register(), value);
        }
        registers.set(Fixed::Touching.register(), 1.0);
        registers.set(Fixed::Elapsed.register(), ELAPSED);
        let state = |i: usize| layout.state(Id::new(i));
        let local = |i: usize| layout.locals(behavior) + i as u16;
        for (i, &value) in naive.states.iter().enumerate() {
            registers.set(state(i), value);
        }
        for (i, &value) in naive.locals.iter().enumerate() {
            registers.set(local(i), value);
        }

        let answer = run(&code, &mut registers, &mut host);
        if whole {
            assert_eq!(answer, naive.law(&law), "seed {seed}");
        } else {
            naive.block(&law.control);
        }
        for (i, &value) in naive.states.iter().enumerate() {
            let got = registers.get(state(i));
            assert!(
                same(got, value),
                "seed {seed}, state {i}: {got} not {value}"
            );
        }
        for (i, &value) in naive.locals.iter().enumerate() {
            let got = registers.get(local(i));
            assert!(
                same(got, value),
                "seed {seed}, local {i}: {got} not {value}"
            );
        }
        for (fixed, value) in [Fixed::Speed, Fixed::Strafe, Fixed::Turn]
            .into_iter()
            .zip(naive.drive)
        {
            let got = registers.get(fixed.register());
            assert!(
                same(got, value),
                "seed {seed}, {fixed:?}: {got} not {value}"
            );
        }
        assert_eq!(
            host.random.word(),
            naive.host.random.word(),
            "seed {seed}: as many draws"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn control_laws_run_as_they_read(seed: u64) {
        compare(seed, false, By::Interpreter);
    }

    #[test]
    fn partitions_run_as_they_read(seed: u64) {
        compare(seed, true, By::Interpreter);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn compiled_laws_run_as_they_read(seed: u64) {
        compare(seed, false, By::Processor);
        compare(seed, true, By::Processor);
    }
}

/// A program with more constants than registers is refused, not cut short.
#[test]
fn a_program_that_does_not_fit_is_an_error() {
    let (mut program, _) = invent(1);
    let mut sum = program.pool.leaf(Expr::State(Id::new(0)));
    for i in 0..5000 {
        let number = program.pool.num(f64::from(i) + 0.5);
        sum = program.pool.binary(Binary::Add, sum, number);
    }
    let mut layout = Layout::new(&program).unwrap();
    let mut compiler = Compiler::new(&program.pool, &mut layout, None);
    assert!(compiler.assign(Fixed::Speed.register(), sum).is_err());
}

/// What only one branch reads is computed in that branch.
#[test]
fn a_let_is_computed_where_it_is_read() {
    let mut program = Program::default();
    let heading = program.pool.leaf(Expr::Pose(Pose::Heading));
    let sine = program.pool.unary(Unary::Sin, heading);
    let temp = program.temps.push(Temp {
        name: "s".into(),
        stays: Stays::ANY,
    });
    let read = program.pool.leaf(Expr::Temp(temp));
    let condition = program.pool.leaf(Expr::Touching);
    let zero = program.pool.num(0.0);
    let block = Block(vec![
        Stmt::Let(temp, sine),
        Stmt::If(
            condition,
            Block(vec![Stmt::Drive {
                speed: read,
                strafe: zero,
                turn: zero,
            }]),
            Block::default(),
        ),
    ]);
    let mut layout = Layout::new(&program).unwrap();
    let mut compiler = Compiler::new(&program.pool, &mut layout, None);
    compiler.block(&block).unwrap();
    let code = compiler.finish().unwrap();
    let ops: Vec<_> = code
        .instructions()
        .iter()
        .map(|instruction| format!("{:?}", instruction.op))
        .collect();
    assert_eq!(ops, ["JumpUnless", "Sin"]);
}

/// What the table of operators says where IEEE 754 leaves a choice or a reader might expect another.
#[test]
fn operators_at_their_edges() {
    let nan = f64::NAN;
    for (op, a, value) in [
        (Unary::Sign, nan, 0.0),
        (Unary::Sign, -0.0, 0.0),
        (Unary::Sign, -3.0, -1.0),
        (Unary::Round, 2.5, 3.0),
        (Unary::Round, -2.5, -3.0),
        (Unary::Wrap, PI, -PI),
        (Unary::Not, nan, 0.0),
        (Unary::Not, 0.0, 1.0),
    ] {
        assert_eq!(op.apply(a), value, "{op:?} {a}");
    }
    for (op, a, b, value) in [
        (Binary::Min, nan, 1.0, nan),
        (Binary::Min, 1.0, nan, 1.0),
        (Binary::Max, nan, 1.0, nan),
        (Binary::Max, 1.0, nan, 1.0),
        (Binary::Div, 1.0, 0.0, f64::INFINITY),
        (Binary::Div, 0.0, 0.0, nan),
        (Binary::Eq, nan, nan, 0.0),
        (Binary::Ne, nan, nan, 1.0),
        (Binary::Le, nan, nan, 0.0),
        (Binary::And, nan, 1.0, 1.0),
        (Binary::Or, 0.0, -0.0, 0.0),
        (Binary::Atan2, 1.0, 0.0, PI / 2.0),
        (Binary::Hypot, 3.0, -4.0, 5.0),
    ] {
        let found = op.apply(a, b);
        assert!(same(found, value), "{op:?} {a} {b}: {found}");
    }
}

/// A distance that is compared with its own length, or one number beside it: both ways of reading agree on each.
#[test]
fn a_distance_is_compared_to_the_last_bit() {
    let operators = [Binary::Lt, Binary::Le];
    let mut random = Random::new(1, 0, 0);
    for case in 0..3000 {
        // Of many sizes, down to those whose squares are no normal numbers and up to those that have none.
        let size = [1.0, 1.0, 1e-160, 1e-170, 1e150, 1e160][case % 6];
        let (x, y) = (
            size * random.uniform(-2.0, 2.0),
            size * random.uniform(-2.0, 2.0),
        );
        let length = btc::math::hypot(x, y);
        for radius in [length.next_down(), length, length.next_up(), f64::MAX] {
            for op in operators {
                for turned in [false, true] {
                    let mut program = Program::default();
                    let [px, py] =
                        [Pose::X, Pose::Y].map(|pose| program.pool.leaf(Expr::Pose(pose)));
                    let distance = program.pool.binary(Binary::Hypot, px, py);
                    let constant = program.pool.num(radius);
                    let (a, b) = if turned {
                        (constant, distance)
                    } else {
                        (distance, constant)
                    };
                    let id = program.pool.binary(op, a, b);
                    let mut layout = Layout::new(&program).unwrap();
                    let mut compiler = Compiler::new(&program.pool, &mut layout, None);
                    compiler.assign(Fixed::Speed.register(), id).unwrap();
                    let code = compiler.finish().unwrap();
                    let mut registers = layout.registers();
                    registers.set(Fixed::X.register(), x);
                    registers.set(Fixed::Y.register(), y);
                    let mut host = Numbers {
                        random: Random::new(1, 0, 0),
                        atoms: 0,
                    };
                    run(&code, &mut registers, &mut host);
                    let read = if turned {
                        op.apply(radius, length)
                    } else {
                        op.apply(length, radius)
                    };
                    let got = registers.get(Fixed::Speed.register());
                    assert_eq!(got, read, "{op:?} {turned} ({x}, {y}) {radius}");
                }
            }
        }
    }
}
