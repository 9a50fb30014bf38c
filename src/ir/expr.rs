//! Expressions: a pool of scalar nodes, shared and folded as they are made.
//!
//! Points are two nodes, targets have become arithmetic on the pose, `let`s that only name a value are shared nodes.
//! What is left is numbers and truth values; both run as `f64`.

use super::input::Input;
use super::law::Behavior;
use super::name::Name;
pub use super::operator::{Binary, Kind, Unary};
use super::program::{Event, State, Stays};
use super::table::Id;
use super::tree::Status;
use super::world::{Place, Robot, Sensor, Wall};
use rustc_hash::FxHashMap;

/// A behaviour's own variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Local {
    /// Its name.
    pub name: Name,
    /// Its value when the behaviour starts; later ones may read earlier ones.
    pub initial: ExprId,
    /// The values that it may have, as far as the text shows.
    pub stays: Stays,
}

/// A name that a statement binds.
#[derive(Clone, Debug, PartialEq)]
pub struct Temp {
    /// The name.
    pub name: Name,
    /// The values that it may have, as far as what the world allows shows.
    pub stays: Stays,
}

/// An expression of the [`Pool`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExprId(u32);

impl ExprId {
    /// The position in the pool; operands stand before the nodes that use them.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expr {
    /// A number in SI base units, or an enum's variant.
    Num(f64),
    /// A truth value.
    Bool(bool),
    /// A state variable as it is now.
    State(Id<State>),
    /// An input as it is now.
    Input(Id<Input>),
    /// A variable of the behaviour as it is now.
    Local(Id<Local>),
    /// A name that a statement has bound.
    Temp(Id<Temp>),
    /// The robot's pose.
    Pose(Pose),
    /// The pose of another robot, by its place among all robots.
    Robot(Id<Robot>, Pose),
    /// Whether the last tick's commanded motion was blocked.
    Touching,
    /// Seconds since the behaviour started.
    Elapsed,
    /// Whether no wall stands between the robot's centre and the point.
    Visible(ExprId, ExprId),
    /// The wall or arena boundary that is nearest to the robot's centre.
    NearestWall(Echo),
    /// One wall.
    Wall(Id<Wall>, Echo),
    /// A sensor's reading.
    Sensor(Id<Sensor>, Echo),
    /// Whether the robot's centre is in a place that is not a disc.
    Inside(Id<Place>),
    /// Whether the behaviour ended so in this tick, or was running in it; in events, effects and rewards.
    Ended(Id<Behavior>, Status),
    /// Whether the event happens in this tick.
    Event(Id<Event>),
    /// How often the learner has tried this behaviour in this minterm, this time included.
    Visits,
    /// How much of the learning is done, from 0 to 1.
    Progress,
    /// One operand.
    Unary(Unary, ExprId),
    /// Two operands.
    Binary(Binary, ExprId, ExprId),
    /// The second operand if the first holds, else the third.
    Select(ExprId, ExprId, ExprId),
    /// A random draw; each one in the text has its number.
    Draw(u32, Draw),
}

/// What is read of the robot's own pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Pose {
    /// The x coordinate in metres.
    X,
    /// The y coordinate in metres.
    Y,
    /// The heading in [−π, π).
    Heading,
}

/// What is read of an echo.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Echo {
    /// The distance from the robot's centre in metres.
    Distance,
    /// The direction in the plane, in [−π, π).
    Direction,
    /// Whether there is one.
    Seen,
}

/// Random draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Draw {
    /// Uniform in [a, b).
    Uniform(ExprId, ExprId),
    /// Gaussian of this mean and standard deviation.
    Normal(ExprId, ExprId),
    /// True with this probability.
    Chance(ExprId),
    /// One of 0 … n − 1.
    Pick(u32),
}

/// Every expression of a program, each node once.
#[derive(Clone, Debug, Default)]
pub struct Pool {
    nodes: Vec<Expr>,
    known: FxHashMap<Key, ExprId>,
    draws: u32,
}

/// A node up to the bits of its number.
type Key = (std::mem::Discriminant<Expr>, u64, u64);

impl Pool {
    /// The node.
    #[allow(
        clippy::indexing_slicing,
        reason = "ids are made by this pool and nodes are never removed"
    )]
    pub fn get(&self, id: ExprId) -> Expr {
        self.nodes[id.index()]
    }

    /// The number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The nodes with their ids; operands stand before the nodes that use them.
    pub fn iter(&self) -> impl Iterator<Item = (ExprId, Expr)> {
        (0..).map(ExprId).zip(self.nodes.iter().copied())
    }

    /// A number.
    pub fn num(&mut self, value: f64) -> ExprId {
        self.add(Expr::Num(value))
    }

    /// A truth value.
    pub fn bool(&mut self, value: bool) -> ExprId {
        self.add(Expr::Bool(value))
    }

    fn literal(&mut self, kind: Kind, value: f64) -> ExprId {
        match kind {
            Kind::Truth => self.bool(value != 0.0),
            _ => self.num(value),
        }
    }

    /// The value of a constant; a truth value is 0 or 1.
    pub fn constant(&self, id: ExprId) -> Option<f64> {
        match self.get(id) {
            Expr::Num(value) => Some(value),
            Expr::Bool(value) => Some(f64::from(value)),
            _ => None,
        }
    }

    /// A leaf such as a state or a reading.
    pub fn leaf(&mut self, expr: Expr) -> ExprId {
        self.add(expr)
    }

    /// A new draw, different from every other.
    pub fn draw(&mut self, draw: Draw) -> ExprId {
        let number = self.draws;
        self.draws += 1;
        let id = ExprId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push(Expr::Draw(number, draw));
        id
    }

    /// A function of one operand, folded where it is constant.
    pub fn unary(&mut self, op: Unary, a: ExprId) -> ExprId {
        if let Some(value) = self.constant(a) {
            return self.literal(op.gives(), op.apply(value));
        }
        if let (Unary::Not | Unary::Neg, Expr::Unary(inner, b)) = (op, self.get(a))
            && op == inner
        {
            return b;
        }
        self.add(Expr::Unary(op, a))
    }

    /// A function of two operands, folded where it is constant, or where one operand decides.
    pub fn binary(&mut self, op: Binary, a: ExprId, b: ExprId) -> ExprId {
        match (self.constant(a), self.constant(b)) {
            (Some(x), Some(y)) => {
                return self.literal(op.gives(), op.apply(x, y));
            }
            (Some(x), None) => match op {
                Binary::And => return if x == 0.0 { a } else { b },
                Binary::Or => return if x == 0.0 { b } else { a },
                Binary::Mul if x == 1.0 => return b,
                _ => {}
            },
            (None, Some(y)) => match op {
                Binary::And => return if y == 0.0 { b } else { a },
                Binary::Or => return if y == 0.0 { a } else { b },
                Binary::Mul | Binary::Div if y == 1.0 => return a,
                Binary::Sub if y == 0.0 => return a,
                _ => {}
            },
            (None, None) => {}
        }
        self.add(Expr::Binary(op, a, b))
    }

    /// A choice, folded where the condition is constant or both sides are one.
    pub fn select(&mut self, condition: ExprId, then: ExprId, otherwise: ExprId) -> ExprId {
        match self.constant(condition) {
            Some(0.0) => otherwise,
            Some(_) => then,
            None if then == otherwise => then,
            None => self.add(Expr::Select(condition, then, otherwise)),
        }
    }

    /// `not a`
    pub fn not(&mut self, a: ExprId) -> ExprId {
        self.unary(Unary::Not, a)
    }

    /// `a and b`
    pub fn and(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Binary::And, a, b)
    }

    /// `a or b`
    pub fn or(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Binary::Or, a, b)
    }

    /// The operands of a node, in order.
    pub fn operands(&self, id: ExprId) -> impl Iterator<Item = ExprId> + use<> {
        let three = match self.get(id) {
            Expr::Unary(_, a) | Expr::Draw(_, Draw::Chance(a)) => [Some(a), None, None],
            Expr::Binary(_, a, b)
            | Expr::Visible(a, b)
            | Expr::Draw(_, Draw::Uniform(a, b) | Draw::Normal(a, b)) => [Some(a), Some(b), None],
            Expr::Select(a, b, c) => [Some(a), Some(b), Some(c)],
            _ => [None; 3],
        };
        three.into_iter().flatten()
    }

    /// Whether `test` passes for the node or anything that it depends on.
    pub fn any(&self, id: ExprId, test: &mut impl FnMut(Expr) -> bool) -> bool {
        let mut seen = rustc_hash::FxHashSet::default();
        let mut open = vec![id];
        while let Some(id) = open.pop() {
            if seen.insert(id) {
                if test(self.get(id)) {
                    return true;
                }
                open.extend(self.operands(id));
            }
        }
        false
    }

    fn add(&mut self, expr: Expr) -> ExprId {
        let next = ExprId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        let id = *self.known.entry(key(expr)).or_insert(next);
        if id == next {
            self.nodes.push(expr);
        }
        id
    }
}

/// What distinguishes a node from every other of the pool.
fn key(expr: Expr) -> Key {
    let pair = |a: usize, b: usize| ((a as u64) << 32) | (b as u64 & 0xffff_ffff);
    let (a, b) = match expr {
        Expr::Num(value) => (value.to_bits(), 0),
        Expr::Bool(value) => (u64::from(value), 0),
        Expr::State(id) => (id.index() as u64, 0),
        Expr::Input(id) => (id.index() as u64, 0),
        Expr::Local(id) => (id.index() as u64, 0),
        Expr::Temp(id) => (id.index() as u64, 0),
        Expr::Pose(pose) => (pose as u64, 0),
        Expr::Robot(id, pose) => (id.index() as u64, pose as u64),
        Expr::Touching | Expr::Elapsed | Expr::Visits | Expr::Progress => (0, 0),
        Expr::Visible(a, b) => (pair(a.index(), b.index()), 0),
        Expr::NearestWall(echo) => (echo as u64, 0),
        Expr::Wall(id, echo) => (id.index() as u64, echo as u64),
        Expr::Sensor(id, echo) => (id.index() as u64, echo as u64),
        Expr::Inside(id) => (id.index() as u64, 0),
        Expr::Ended(id, status) => (id.index() as u64, status as u64),
        Expr::Event(id) => (id.index() as u64, 0),
        Expr::Unary(op, a) => (op as u64, a.index() as u64),
        Expr::Binary(op, a, b) => (op as u64, pair(a.index(), b.index())),
        Expr::Select(a, b, c) => (a.index() as u64, pair(b.index(), c.index())),
        Expr::Draw(number, _) => (u64::from(number), 0),
    };
    (std::mem::discriminant(&expr), a, b)
}

impl std::ops::Index<ExprId> for Pool {
    type Output = Expr;
    #[allow(
        clippy::indexing_slicing,
        reason = "ids are made by this pool and nodes are never removed"
    )]
    fn index(&self, id: ExprId) -> &Expr {
        &self.nodes[id.index()]
    }
}
