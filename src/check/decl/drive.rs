//! `drive`: what a control law commands, once on every path.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::report::short;
use crate::check::signature::{Signature, Takes};
use crate::check::types::units::Dim;
use crate::check::types::{Type, Typed};
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::ir::expr::{Binary, Expr, Pose, Unary};
use crate::ir::law::Stmt;
use crate::ir::world::{DriveKind, Robot};
use crate::source::Span;
use crate::syntax::ast::{self, Arg, ArgKind, BinaryOp, Else, ExprKind, Ref, StmtKind};
use crate::syntax::print;

/// What `drive` commands.
const COMMANDS: [(&str, Type); 4] = [
    ("speed", Type::SPEED),
    ("turn", Type::TURN_RATE),
    ("strafe", Type::SPEED),
    ("course", Type::ANGLE),
];

/// How a differential drive takes a course: it turns by this much a second for each part of a turn that it is off, and
/// stands while it is off by more than this angle.
const GAIN: f64 = 4.0;
const ROUGHLY: f64 = 0.6;

/// A command of more than so many times what a drive does is likely written in a wrong unit.
const FAR: f64 = 2.0;

impl<'a> Checker<'a> {
    /// `drive(speed, turn, strafe)`, `drive(course, speed)`
    pub fn drive_stmt(&mut self, call: &'a Ref) -> Option<Stmt> {
        if self.context.region != Region::Control {
            return self
                .error(Code::E0307, call.name.span, "an effect does not drive")
                .label("only a control law does")
                .none();
        }
        let signature = Signature {
            owner: "`drive`",
            takes: Takes::Parameters {
                names: &COMMANDS.map(|(name, _)| name),
                words: "a speed and a turn rate, or a course",
            },
        };
        let matched = self.matched(&signature, call.args.as_deref().unwrap_or_default());
        let mut fine = matched.fine;
        let told = self.diagnostics.len();
        let only = call.args.as_ref().is_some_and(|args| args.len() == 1);
        let mut commands = [None, None, None, None];
        for ((arg, (name, ty)), command) in matched.args().zip(COMMANDS).zip(&mut commands) {
            let Some((arg, value)) = arg else { continue };
            if name == "strafe" && !self.drive_unsure && !self.is_holonomic() {
                self.error(
                    Code::E0305,
                    arg.span,
                    "a differential drive cannot move sideways",
                )
                .label("`strafe` needs `drive = holonomic(…)`");
                fine = false;
                continue;
            }
            let given = self.expr_like(value, &ty);
            let angle = given.ty.dim() == Some(Dim::ANGLE);
            let given = self.coerce(given, value, &ty, &format!("`{name}`"));
            self.beyond_the_drive(name, value.span, &given);
            *command = Some(given);
            if name == "course" {
                self.bearing_for_course(value);
            } else if let (ArgKind::Named(word, _), true, Some(last)) =
                (&arg.kind, angle && only, self.diagnostics.last_mut())
                && last.fixes.is_empty()
            {
                *last = last.clone().fix(
                    "a direction is a `course`",
                    word.span,
                    "course",
                    Applicability::Unsafe,
                );
            }
        }
        fine &= !self.commands_by_name(call.args.as_deref().unwrap_or_default(), told);
        let [speed, turn, strafe, course] = commands;
        if let Some(course) = course {
            return self.drive_on_course(call, [speed, turn, strafe], &course);
        }
        let lacks = match (&speed, &turn) {
            (None, None) => Some((
                "`speed` and its `turn`",
                "to stand, leave `drive` out: `drive(speed = 20 cm/s, turn = 0 rad/s)` goes straight on",
            )),
            (None, Some(_)) => Some(("`speed`", "to turn on the spot, write `speed = 0 m/s`")),
            (Some(_), None) => Some(("`turn`", "to go straight on, write `turn = 0 rad/s`")),
            (Some(_), Some(_)) => None,
        };
        // Which command was meant by one that is wrong, nobody knows.
        let wrong = [&speed, &turn].into_iter().flatten();
        fine &= wrong.into_iter().all(|given| given.ty != Type::Error);
        if let Some((what, still)) = lacks.filter(|_| fine) {
            let message = format!("`drive` needs its {what}");
            self.error(Code::E0305, call.name.span, message)
                .label("not given")
                .help(still);
        }
        let zero = self.program.pool.num(0.0);
        Some(Stmt::Drive {
            speed: speed?.scalar()?,
            turn: turn?.scalar()?,
            strafe: match strafe {
                Some(strafe) => strafe.scalar()?,
                None => zero,
            },
        })
    }

    /// `drive(course = direction(A))`: a holonomic drive goes that way at once, a differential one turns into it.
    fn drive_on_course(
        &mut self,
        call: &'a Ref,
        [speed, turn, strafe]: [Option<Typed>; 3],
        course: &Typed,
    ) -> Option<Stmt> {
        let holonomic = self.is_holonomic();
        for (name, given) in [("strafe", &strafe), ("turn", &turn)] {
            let unsure = self.drive_unsure;
            if given.is_some() && !unsure && (name == "strafe" || !holonomic) {
                let message = format!("a `course` says what `{name}` would say");
                return self
                    .error(Code::E0305, call.name.span, message)
                    .label("give one of the two")
                    .none();
            }
        }
        let speed = match speed {
            Some(speed) => speed.scalar()?,
            None => {
                let most = self.subject_robot()?.drive.max_speed;
                self.program.pool.num(most)
            }
        };
        let course = course.scalar()?;
        let most = self.subject_robot()?.drive.max_turn;
        let pool = &mut self.program.pool;
        let heading = pool.leaf(Expr::Pose(Pose::Heading));
        let off = pool.binary(Binary::Sub, course, heading);
        let off = pool.unary(Unary::Wrap, off);
        let zero = pool.num(0.0);
        if holonomic {
            let (ahead, aside) = (pool.unary(Unary::Cos, off), pool.unary(Unary::Sin, off));
            let turn = match turn {
                Some(turn) => turn.scalar()?,
                None => zero,
            };
            let pool = &mut self.program.pool;
            return Some(Stmt::Drive {
                speed: pool.binary(Binary::Mul, speed, ahead),
                strafe: pool.binary(Binary::Mul, speed, aside),
                turn,
            });
        }
        let gain = pool.num(GAIN);
        let (low, high) = (pool.num(-most), pool.num(most));
        let turn = pool.binary(Binary::Mul, gain, off);
        let turn = pool.binary(Binary::Max, turn, low);
        let turn = pool.binary(Binary::Min, turn, high);
        let size = pool.unary(Unary::Abs, off);
        let roughly = pool.num(ROUGHLY);
        let ahead = pool.binary(Binary::Le, size, roughly);
        Some(Stmt::Drive {
            speed: pool.select(ahead, speed, zero),
            strafe: zero,
            turn,
        })
    }

    /// Warns of a command that is far beyond what the drive does.
    fn beyond_the_drive(&mut self, command: &str, at: Span, given: &Typed) {
        let asked = given.scalar().and_then(|id| self.program.pool.constant(id));
        let Some((asked, robot)) = asked.zip(self.subject_robot()) else {
            return;
        };
        let (most, unit) = match command {
            "speed" | "strafe" => (robot.drive.max_speed, "m/s"),
            "turn" => (robot.drive.max_turn, "rad/s"),
            _ => return,
        };
        if self.context.library || most <= 0.0 || asked.abs() <= FAR * most {
            return;
        }
        let message = format!("the `{command}` is far beyond what the drive does");
        self.warning(Code::W0402, at, message)
            .label(format!("at most {} {unit} come of it", short(most)));
    }

    /// Warns of a bearing, which is from the heading, where a course is a direction in the arena.
    pub fn bearing_for_course(&mut self, value: &ast::Expr) {
        let Some(called) = bearing_in(value) else {
            return;
        };
        if self.context.library || self.names.value("bearing", false).is_some() {
            return;
        }
        self.warning(
            Code::W0306,
            value.span,
            "a course is a direction, and this is a bearing",
        )
        .label("an angle from the heading")
        .write(called.name.span, "direction", Applicability::Unsafe)
        .note("a course is an angle from the x axis of the arena, as `heading` is");
    }

    /// Makes one mistake of commands that stand in each other's place, if each is told by its type. Whether there was one.
    fn commands_by_name(&mut self, args: &'a [Arg], told: usize) -> bool {
        let wrong = self.diagnostics.get(told..).unwrap_or_default();
        let mismatch = |found: &Diagnostic| {
            matches!(found.code, Code::E0301 | Code::E0302) && found.fixes.is_empty()
        };
        if wrong.is_empty() || !wrong.iter().all(mismatch) {
            return false;
        }
        let mut free: Vec<(&str, Type)> = COMMANDS.to_vec();
        let mut named = Vec::new();
        for arg in args {
            let ArgKind::Positional(value) = &arg.kind else {
                return false;
            };
            let (typed, _) = self.captured(|checker| checker.expr(value));
            let fits = |(_, ty): &(&str, Type)| typed.ty != Type::Error && typed.ty.fits(ty);
            let Some(at) = free.iter().position(fits) else {
                return false;
            };
            let (name, _) = free.remove(at);
            named.push(format!("{name} = {}", print::expr(value)));
        }
        let (Some(first), Some(last)) = (args.first(), args.last()) else {
            return false;
        };
        self.diagnostics.truncate(told);
        let span = first.span.to(last.span);
        let right = named.join(", ");
        self.error(Code::E0305, span, "the commands of `drive` go by name")
            .label("by position they are a speed and a turn rate")
            .fix(
                format!("write `{right}`"),
                span,
                right,
                Applicability::Unsafe,
            );
        true
    }

    fn is_holonomic(&self) -> bool {
        let Some(world) = &self.program.world else {
            return false;
        };
        let holonomic = |robot: &Robot| robot.drive.kind == DriveKind::Holonomic;
        match self.bodies.for_itself() {
            true => world.robots().any(holonomic),
            false => holonomic(world.robot_of(self.subject)),
        }
    }

    /// Reports every `drive` that a path reaches after another. The place of the last `drive` that some path reaches,
    /// `before` the block or in it.
    pub fn drives_once(&mut self, block: &'a ast::Block, mut before: Option<Span>) -> Option<Span> {
        for stmt in &block.stmts {
            match &stmt.kind {
                StmtKind::Call(call) if call.name.name == "drive" => {
                    let here = call.name.span;
                    if let Some(first) = before {
                        self.error(Code::E0311, here, "this path drives twice")
                            .label("a second command in one tick")
                            .also(first, "the first is here");
                    }
                    before = Some(here);
                }
                StmtKind::Branch(branch) => before = self.branch_drives(branch, before),
                StmtKind::For { block, .. } => before = self.drives_once(block, before),
                _ => {}
            }
        }
        before
    }

    fn branch_drives(&mut self, branch: &'a ast::Branch, before: Option<Span>) -> Option<Span> {
        let then = self.drives_once(&branch.then, before);
        let otherwise = match branch.otherwise.as_deref() {
            None => before,
            Some(Else::Block(block)) => self.drives_once(block, before),
            Some(Else::If(inner)) => self.branch_drives(inner, before),
        };
        then.or(otherwise)
    }
}

/// The bearing that an angle is made of, if it is not made of the heading as well.
fn bearing_in(value: &ast::Expr) -> Option<&ast::Ref> {
    let summands = summands(value);
    let mut named = summands.iter();
    let with_heading = named.any(|called| called.name.name == "heading");
    let mut bearings = summands.into_iter();
    let bearing = bearings.find(|called| called.name.name == "bearing");
    bearing.filter(|_| !with_heading)
}

/// The names and calls that a sum is made of, and what is wrapped.
fn summands(value: &ast::Expr) -> Vec<&ast::Ref> {
    let (mut found, mut open) = (Vec::new(), vec![value]);
    while let Some(value) = open.pop() {
        match &value.kind {
            ExprKind::Paren(inner) => open.push(inner),
            ExprKind::Ref(called) if called.name.name == "wrap" => {
                let args = called.args.iter().flatten();
                open.extend(args.filter_map(|arg| match &arg.kind {
                    ArgKind::Positional(value) => Some(value),
                    _ => None,
                }));
            }
            ExprKind::Ref(called) => found.push(called),
            ExprKind::Binary { op, left, right }
                if matches!(op.node, BinaryOp::Add | BinaryOp::Sub) =>
            {
                open.extend([&**left, &**right]);
            }
            _ => {}
        }
    }
    found
}
