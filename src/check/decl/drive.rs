//! `drive`: what a control law commands, once on every path.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::signature::{Signature, Takes};
use crate::check::types::Type;
use crate::diagnostic::Code;
use crate::ir::law::Stmt;
use crate::ir::world::DriveKind;
use crate::source::Span;
use crate::syntax::ast::{self, Else, Ref, StmtKind};

/// What `drive` commands.
const COMMANDS: [(&str, Type); 3] = [
    ("speed", Type::SPEED),
    ("turn", Type::TURN_RATE),
    ("strafe", Type::SPEED),
];

impl<'a> Checker<'a> {
    /// `drive(speed, turn, strafe)`
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
                words: "a speed and a turn rate",
            },
        };
        let matched = self.matched(&signature, call.args.as_deref().unwrap_or_default());
        let mut fine = matched.fine;
        let mut commands = [None, None, None];
        for ((arg, (name, ty)), command) in matched.args().zip(COMMANDS).zip(&mut commands) {
            let Some((arg, value)) = arg else { continue };
            if name == "strafe" && self.drive_known && !self.is_holonomic() {
                self.error(
                    Code::E0305,
                    arg.span,
                    "a differential drive cannot move sideways",
                )
                .label("`strafe` needs `drive = holonomic(…)`");
                fine = false;
                continue;
            }
            *command = Some(self.expect(value, &ty, &format!("`{name}`")));
        }
        let [speed, turn, strafe] = commands;
        for (name, command, still) in [
            (
                "speed",
                &speed,
                "to turn on the spot, write `speed = 0 m/s`",
            ),
            ("turn", &turn, "to go straight on, write `turn = 0 rad/s`"),
        ] {
            if command.is_none() && fine {
                self.error(
                    Code::E0305,
                    call.name.span,
                    format!("`drive` needs its `{name}`"),
                )
                .label(format!("`{name}` is not given"))
                .help(still);
            }
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

    fn is_holonomic(&self) -> bool {
        let world = self.program.world.as_ref();
        world.is_some_and(|world| world.robot.drive.kind == DriveKind::Holonomic)
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
