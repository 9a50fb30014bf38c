//! Expressions as values in registers.

use super::code::{Op, Register};
use super::compiler::{Binding, Compiler, Label, TooLarge};
use super::layout::{Fixed, Source};
use crate::ir::expr::{Binary, Draw, Echo, Pose, Unary};
use crate::ir::{Expr, ExprId};

/// A value of this cost or more, in additions, is worth a jump around it.
const WORTH_A_JUMP: u32 = 3;

impl Compiler<'_> {
    /// The register that holds the value of an expression, computed here unless it is known.
    ///
    /// # Errors
    /// If registers run out.
    pub(super) fn value(&mut self, id: ExprId) -> Result<Register, TooLarge> {
        if let Some(register) = self.memo.get(id) {
            return Ok(register);
        }
        Ok(match self.pool.get(id) {
            Expr::Num(value) => self.layout.constant(value)?,
            Expr::Bool(value) => self.layout.constant(f64::from(value))?,
            Expr::State(state) => self.layout.state(state),
            // A program with a world has no inputs.
            Expr::Input(_) => self.layout.constant(0.0)?,
            Expr::Local(local) => self.local(local),
            Expr::Temp(temp) => match self.temps.get(&temp) {
                Some(&Binding::Known(register)) => register,
                Some(&Binding::Deferred(value)) => self.value(value)?,
                None => self.layout.constant(0.0)?,
            },
            Expr::Pose(Pose::X) => Fixed::X.register(),
            Expr::Pose(Pose::Y) => Fixed::Y.register(),
            Expr::Pose(Pose::Heading) => Fixed::Heading.register(),
            Expr::Robot(robot, pose) => self.layout.robot(robot, pose),
            Expr::Touching => Fixed::Touching.register(),
            Expr::Elapsed => {
                self.timed = true;
                Fixed::Elapsed.register()
            }
            Expr::Visits => Fixed::Visits.register(),
            Expr::Progress => Fixed::Progress.register(),
            Expr::Event(event) => self.layout.event(event),
            Expr::Ended(behavior, status) => match self.layout.ended(behavior, status) {
                Some(register) => register,
                None => self.layout.constant(0.0)?,
            },
            Expr::NearestWall(echo) => self.echo(id, Source::NearestWall, echo)?,
            Expr::Sensor(sensor, echo) => self.echo(id, Source::Sensor(sensor), echo)?,
            Expr::Wall(wall, echo) => self.echo(id, Source::Wall(wall), echo)?,
            Expr::Inside(place) => self.result(id, Op::Inside, place.index() as Register, 0)?,
            Expr::Visible(x, y) => self.visible(id, x, y)?,
            Expr::Unary(op, a) => match (op, self.pool.get(a)) {
                (Unary::Wrap, Expr::Binary(Binary::Sub, a, b)) => {
                    self.binary(id, Op::WrapSub, a, b)?
                }
                _ => {
                    let a = self.value(a)?;
                    self.result(id, op.into(), a, 0)?
                }
            },
            Expr::Binary(op @ (Binary::And | Binary::Or), a, b) => self.junction(id, op, a, b)?,
            Expr::Binary(op, a, b) => match self.clamp(op, a, b) {
                Some((a, limit)) => self.binary(id, Op::Clamp, a, limit)?,
                None => {
                    if let Some(near) = self.near(op, a, b)? {
                        self.memo.insert(id, near);
                        return Ok(near);
                    }
                    let (a, b) = self.compared(op, a, b)?;
                    self.result(id, op.into(), a, b)?
                }
            },
            Expr::Select(condition, then, otherwise) => {
                let dst = self.fresh()?;
                self.select_into(dst, [condition, then, otherwise])?;
                self.memo.insert(id, dst);
                dst
            }
            Expr::Draw(_, draw) => {
                let register = self.draw(draw)?;
                self.memo.insert(id, register);
                register
            }
        })
    }

    fn binary(&mut self, id: ExprId, op: Op, a: ExprId, b: ExprId) -> Result<Register, TooLarge> {
        let a = self.value(a)?;
        let b = self.value(b)?;
        self.result(id, op, a, b)
    }

    fn result(
        &mut self,
        id: ExprId,
        op: Op,
        a: Register,
        b: Register,
    ) -> Result<Register, TooLarge> {
        let dst = self.fresh()?;
        self.emit(op, dst, a, b);
        self.memo.insert(id, dst);
        Ok(dst)
    }

    /// Whether a point is in sight.
    fn visible(&mut self, id: ExprId, x: ExprId, y: ExprId) -> Result<Register, TooLarge> {
        if let (Some(at_x), Some(at_y)) = (self.pool.constant(x), self.pool.constant(y))
            && let Some(first) = self.layout.sight([at_x, at_y])
        {
            let (x, y) = (self.value(x)?, self.value(y)?);
            self.emit(Op::Sees, first, x, y);
            self.memo.insert(id, first + 1);
            return Ok(first + 1);
        }
        self.binary(id, Op::Visible, x, y)
    }

    /// Whether the nearest wall is nearer than something, or as near, where that is what is asked and the wall has not been
    /// looked at.
    pub(super) fn near(
        &mut self,
        op: Binary,
        a: ExprId,
        b: ExprId,
    ) -> Result<Option<Register>, TooLarge> {
        let op = match op {
            Binary::Lt => Op::Nearer,
            Binary::Le => Op::Within,
            _ => return Ok(None),
        };
        let source = self.layout.source(Source::NearestWall);
        let asked = matches!(self.pool.get(a), Expr::NearestWall(Echo::Distance));
        if !asked || self.memo.has_looked(source) {
            return Ok(None);
        }
        let bound = self.value(b)?;
        let dst = self.fresh()?;
        self.emit(op, dst, self.layout.echo(source), bound);
        Ok(Some(dst))
    }

    fn echo(&mut self, id: ExprId, source: Source, echo: Echo) -> Result<Register, TooLarge> {
        let source = self.layout.source(source);
        let first = self.layout.echo(source);
        if self.memo.look(source) {
            self.emit(Op::Look, first, source, 0);
        }
        match echo {
            Echo::Distance => Ok(first),
            Echo::Seen => Ok(first + 3),
            Echo::Direction => self.result(id, Op::Direction, first + 2, first + 1),
        }
    }

    /// `a and b`, `a or b`: the second is skipped where the first decides and the second costs something.
    fn junction(
        &mut self,
        id: ExprId,
        op: Binary,
        a: ExprId,
        b: ExprId,
    ) -> Result<Register, TooLarge> {
        if self.cost(b) < WORTH_A_JUMP {
            return self.binary(id, op.into(), a, b);
        }
        let dst = self.fresh()?;
        let truth = self.layout.constant(1.0)?;
        let falsehood = self.layout.constant(0.0)?;
        self.emit(Op::Move, dst, falsehood, 0);
        let mut end = Label::default();
        let known = self.condition(id, false, &mut end)?;
        self.emit(Op::Move, dst, truth, 0);
        self.bind(end);
        self.memo.forget(known);
        self.memo.insert(id, dst);
        Ok(dst)
    }

    /// A choice: the side that is not taken is skipped. `dst` must not be read by any of the three.
    pub(super) fn select_into(
        &mut self,
        dst: Register,
        [condition, then, otherwise]: [ExprId; 3],
    ) -> Result<(), TooLarge> {
        let cheap = self.cost(otherwise) < WORTH_A_JUMP;
        if cheap {
            let value = self.value(otherwise)?;
            self.emit(Op::Move, dst, value, 0);
        }
        let mut no = Label::default();
        let known = self.condition(condition, false, &mut no)?;
        self.side(dst, then)?;
        if cheap {
            self.bind(no);
        } else {
            let mut end = Label::default();
            self.jump(Op::Jump, &mut end, 0, 0);
            self.bind(no);
            self.memo.forget(known);
            self.side(dst, otherwise)?;
            self.bind(end);
        }
        self.memo.forget(known);
        Ok(())
    }

    /// One side of a choice.
    fn side(&mut self, dst: Register, id: ExprId) -> Result<(), TooLarge> {
        match self.pool.get(id) {
            Expr::Select(condition, then, otherwise) if self.memo.get(id).is_none() => {
                self.select_into(dst, [condition, then, otherwise])
            }
            _ => self.assign(dst, id),
        }
    }

    /// Makes a draw.
    pub(super) fn draw(&mut self, draw: Draw) -> Result<Register, TooLarge> {
        let (op, a, b) = match draw {
            Draw::Uniform(a, b) => (Op::Uniform, self.value(a)?, self.value(b)?),
            Draw::Normal(a, b) => (Op::Normal, self.value(a)?, self.value(b)?),
            Draw::Chance(a) => (Op::Chance, self.value(a)?, 0),
            Draw::Pick(n) => (Op::Pick, self.layout.constant(f64::from(n))?, 0),
        };
        let dst = self.fresh()?;
        self.emit(op, dst, a, b);
        Ok(dst)
    }

    /// The registers of two operands. Where a distance is compared with a constant, those of the square of the distance and
    /// of a bound on it, which need no root.
    pub(super) fn compared(
        &mut self,
        op: Binary,
        a: ExprId,
        b: ExprId,
    ) -> Result<(Register, Register), TooLarge> {
        let radius = |id| self.pool.constant(id).filter(|&radius| radius >= 0.0);
        let distance = |id| match self.pool.get(id) {
            Expr::Binary(Binary::Hypot, x, y) => Some((x, y)),
            _ => None,
        };
        if matches!(op, Binary::Lt | Binary::Le) {
            let strict = op == Binary::Lt;
            if let (Some((x, y)), Some(radius)) = (distance(a), radius(b)) {
                let square = self.square_sum(x, y)?;
                let bound = if strict { least(radius) } else { most(radius) };
                return Ok((square, self.layout.constant(bound)?));
            }
            if let (Some(radius), Some((x, y))) = (radius(a), distance(b)) {
                let square = self.square_sum(x, y)?;
                let bound = if strict { most(radius) } else { least(radius) };
                return Ok((self.layout.constant(bound)?, square));
            }
        }
        Ok((self.value(a)?, self.value(b)?))
    }

    /// `x² + y²`
    fn square_sum(&mut self, x: ExprId, y: ExprId) -> Result<Register, TooLarge> {
        let x = self.value(x)?;
        let y = self.value(y)?;
        let dst = self.fresh()?;
        self.emit(Op::SquareSum, dst, x, y);
        Ok(dst)
    }

    /// The parts of `min(max(x, −limit), limit)`.
    fn clamp(&self, op: Binary, a: ExprId, b: ExprId) -> Option<(ExprId, ExprId)> {
        let (Binary::Min, Expr::Binary(Binary::Max, x, low)) = (op, self.pool.get(a)) else {
            return None;
        };
        let mirrored = match (self.pool.constant(low), self.pool.constant(b)) {
            (Some(low), Some(high)) => low == -high,
            _ => self.pool.get(low) == Expr::Unary(Unary::Neg, b),
        };
        mirrored.then_some((x, b))
    }

    /// What computing an expression here would cost in additions; not counted further than where a jump pays.
    fn cost(&self, id: ExprId) -> u32 {
        let (mut sum, mut open) = (0, vec![id]);
        while let Some(id) = open.pop() {
            if sum >= WORTH_A_JUMP {
                break;
            }
            if self.memo.get(id).is_some() {
                continue;
            }
            sum += match self.pool.get(id) {
                Expr::Temp(temp) => {
                    if let Some(&Binding::Deferred(value)) = self.temps.get(&temp) {
                        open.push(value);
                    }
                    0
                }
                Expr::NearestWall(echo) => self.look_cost(Source::NearestWall, echo),
                Expr::Sensor(sensor, echo) => self.look_cost(Source::Sensor(sensor), echo),
                Expr::Wall(wall, echo) => self.look_cost(Source::Wall(wall), echo),
                Expr::Visible(..) => 10,
                Expr::Unary(op, _) => op.cost(),
                Expr::Binary(op, ..) => op.cost(),
                Expr::Inside(_) | Expr::Draw(..) => 1,
                Expr::Select(..) => 2,
                _ => 0,
            };
            open.extend(self.pool.operands(id));
        }
        sum
    }

    fn look_cost(&self, source: Source, echo: Echo) -> u32 {
        let looked = self.memo.has_looked(self.layout.source(source));
        if looked && echo != Echo::Direction {
            0
        } else {
            10
        }
    }
}

/// The largest number with a root of at most `radius`, as roots are rounded: a few steps from the square.
fn most(radius: f64) -> f64 {
    let mut square = radius * radius;
    while square.sqrt() > radius {
        square = square.next_down();
    }
    while square < f64::INFINITY && square.next_up().sqrt() <= radius {
        square = square.next_up();
    }
    square
}

/// The smallest number with a root of at least `radius`, as roots are rounded: a few steps from the square.
fn least(radius: f64) -> f64 {
    let mut square = radius * radius;
    while square.sqrt() < radius {
        square = square.next_up();
    }
    while square > 0.0 && square.next_down().sqrt() >= radius {
        square = square.next_down();
    }
    square
}
