//! `start`: what an episode begins with.

use crate::check::Checker;
use crate::check::builtin::Constant;
use crate::check::context::{Context, Region};
use crate::check::expr::plain_ref;
use crate::check::names::{Decl, START_WORDS};
use crate::check::task::history::is_no_end;
use crate::check::types::{Type, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::ExprId;
use crate::ir::task::{History, Placing, StartLine};
use crate::ir::world::Robot;
use crate::ir::{Id, Name};
use crate::syntax::{ast, print};

impl<'a> Checker<'a> {
    /// `start { … }`, for a task of this name that keeps this history.
    pub fn start(
        &mut self,
        start: &'a ast::Start,
        history: Option<(Name, History)>,
    ) -> Vec<StartLine> {
        self.context = Context::new(Region::Start);
        self.kept = history;
        let mut lines: Vec<StartLine> = Vec::new();
        let mut set: Vec<(&ast::Ident, Vec<StartLine>)> = Vec::new();
        for line in &start.lines {
            let name = &line.target.name;
            let scopes = self.ranges(&line.target).unwrap_or_default();
            let built = self.for_each_member(scopes, |checker, _| checker.start_line(line));
            let built: Vec<StartLine> = built.into_iter().flatten().flatten().collect();
            // What is set for a whole family may be set otherwise for a member of it.
            let undone = |known: &StartLine| built.iter().any(|new| known.undone_by(new));
            let first =
                set.iter().find(
                    |(first, known)| match known.is_empty() || built.is_empty() {
                        false => known.iter().all(undone),
                        true => first.name == name.name && line.target.args.is_none(),
                    },
                );
            match first {
                // A kind with one member may lack the other one.
                Some(_) if self.lacks_a_member(&line.target) => {}
                Some((first, _)) => {
                    let message = match first.name == name.name {
                        true => format!("`{}` is set twice", name.name),
                        false => format!("`{}` sets `{}` as well", name.name, first.name),
                    };
                    let first = first.span;
                    self.error(Code::E0503, name.span, message)
                        .label("this line would undo the first")
                        .also(first, "first set here");
                }
                None => set.push((name, built.clone())),
            }
            lines.extend(built);
        }
        self.kept = None;
        lines
    }

    /// Whether what is set is a member of a kind of which another member may be missing: an entry of the world was not
    /// understood, or another kind has nearly its name and something is wrong already.
    fn lacks_a_member(&self, target: &ast::Ref) -> bool {
        let args = target.args.as_deref().unwrap_or_default();
        args.iter().any(|arg| {
            let ast::ArgKind::Positional(member) = &arg.kind else {
                return false;
            };
            let name = plain_ref(member).map(|member| member.name.name.as_str());
            let decl = name.and_then(|name| self.names.value(name, false));
            let Some((Decl::Place(_, Some(kind)) | Decl::Wall(_, Some(kind)), _)) = decl else {
                return false;
            };
            let members = self.kinds.places.iter().chain(&self.kinds.walls);
            let kinds = members.filter_map(|(_, of)| of.as_deref());
            let others = kinds.filter(|other| *other != kind.name);
            let like = self.likely(&kind.name, others).is_some();
            self.entries_lost || like && self.diagnostics.iter().any(Diagnostic::is_error)
        })
    }

    fn start_line(&mut self, line: &'a ast::StartLine) -> Option<Vec<StartLine>> {
        self.context.region = Region::Start;
        let value = &line.value;
        let word = line.target.name.name.as_str();
        if matches!(word, "pose" | "position" | "heading") && line.target.args.is_some() {
            return self.other_line(line);
        }
        match word {
            "pose" => {
                let placings = self.pose(value)?;
                let own = |placing| match placing {
                    Placing::Anywhere(within) => StartLine::Anywhere(within),
                    Placing::Position(x, y) => StartLine::Position(x, y),
                    Placing::Heading(angle) => StartLine::Heading(angle),
                };
                Some(placings.into_iter().map(own).collect())
            }
            "position" => match self.expect(value, &Type::Point, "`position`").value {
                Value::Point(x, y) => {
                    self.starts_at(value, self.subject, (x, y));
                    Some(vec![StartLine::Position(x, y)])
                }
                _ => None,
            },
            "heading" => {
                let angle = self.expect(value, &Type::ANGLE, "`heading`");
                angle.scalar().map(|id| vec![StartLine::Heading(id)])
            }
            "history" => {
                self.context.region = Region::StartHistory;
                let value = match is_no_end(value) {
                    true => self.no_end(value.span),
                    false => self.expr(value),
                };
                if !value.ty.fits(&Type::Termination) {
                    return self
                        .error(
                            Code::E0302,
                            value.span,
                            "`history` starts with the end of a behaviour",
                        )
                        .this_is(&value.ty)
                        .help("for example: `history = success(goto(A))`")
                        .none();
                }
                value.scalar().map(|id| vec![StartLine::History(id)])
            }
            _ => self.state_line(line),
        }
    }

    /// Notes where a robot starts, if that is constant.
    fn starts_at(&mut self, value: &ast::Expr, robot: Id<Robot>, (x, y): (ExprId, ExprId)) {
        let constant = |id| self.program.pool.constant(id);
        if let (Some(x), Some(y)) = (constant(x), constant(y)) {
            self.positions.push((value.span, robot, [x, y]));
        }
    }

    /// `pose(robot) = …` and its like.
    fn other_line(&mut self, line: &'a ast::StartLine) -> Option<Vec<StartLine>> {
        let target = &line.target;
        let &[whose] = self.positional(target, 1, 1)?.as_slice() else {
            return None;
        };
        let robot = self.expect(whose, &Type::Robot, "what stands there");
        // Who names a place there has likely exchanged it with the robot.
        if robot.ty == Type::Error {
            self.captured(|checker| checker.expr(&line.value));
            return None;
        }
        let value = &line.value;
        let word = target.name.name.as_str();
        let placings = match word {
            "pose" => self.pose(value)?,
            "position" => match self.expect(value, &Type::Point, "`position`").value {
                Value::Point(x, y) => vec![Placing::Position(x, y)],
                _ => return None,
            },
            _ => {
                let angle = self.expect(value, &Type::ANGLE, "`heading`");
                vec![Placing::Heading(angle.scalar()?)]
            }
        };
        let Value::Robot(id) = robot.value else {
            return None;
        };
        if let (true, &[Placing::Position(x, y)]) = (word == "position", placings.as_slice()) {
            self.starts_at(value, id, (x, y));
        }
        let line = |placing| match (id == self.subject, placing) {
            (false, placing) => StartLine::Other(id, placing),
            (true, Placing::Anywhere(within)) => StartLine::Anywhere(within),
            (true, Placing::Position(x, y)) => StartLine::Position(x, y),
            (true, Placing::Heading(angle)) => StartLine::Heading(angle),
        };
        Some(placings.into_iter().map(line).collect())
    }

    /// What a `pose` is set to: `anywhere`, perhaps in a place, a point, or a place, whose centre and `facing` it is then.
    fn pose(&mut self, value: &'a ast::Expr) -> Option<Vec<Placing>> {
        if let ast::ExprKind::Ref(reference) = &value.kind
            && reference.name.name == Constant::Anywhere.name()
            && reference.args.as_ref().is_some_and(|args| !args.is_empty())
        {
            let &[place] = self.positional(reference, 1, 1)?.as_slice() else {
                return None;
            };
            let place = self.expect(place, &Type::Place(None), "where the robot is put");
            let number = self.code(&place.value)?;
            return Some(vec![Placing::Anywhere(Some(number))]);
        }
        let value = self.expr(value);
        match (&value.ty, &value.value) {
            (_, Value::Anywhere) => Some(vec![Placing::Anywhere(None)]),
            (_, Value::Point(x, y)) => Some(vec![Placing::Position(*x, *y)]),
            (_, Value::Place(id)) => {
                let (x, y) = self.point_of(&value.value)?;
                let facing = self.program.world.as_ref()?.places[*id].facing;
                let heading = facing.map(|angle| self.program.pool.num(angle));
                let heading = heading.map(Placing::Heading);
                Some(
                    [Placing::Position(x, y)]
                        .into_iter()
                        .chain(heading)
                        .collect(),
                )
            }
            (Type::Place(_), Value::Chosen(..)) => {
                let coordinate = |checker: &mut Self, of: fn((ExprId, ExprId)) -> ExprId| {
                    checker.of_each(&value.value, &mut |checker, place| match place {
                        Value::Place(_) => checker.point_of(place).map(of),
                        _ => Some(checker.program.pool.num(f64::INFINITY)),
                    })
                };
                let x = coordinate(self, |(x, _)| x)?;
                let y = coordinate(self, |(_, y)| y)?;
                Some(vec![Placing::Position(x, y)])
            }
            // A place that was not understood is reported where it is declared.
            (Type::Error, _) | (Type::Place(_), Value::Unknown) => None,
            (ty, _) => self
                .error(
                    Code::E0302,
                    value.span,
                    "`pose` is `anywhere`, a point or a place",
                )
                .this_is(ty)
                .help("a pose of your own: `position = (1 m, 2 m)`, `heading = 90 deg`")
                .none(),
        }
    }

    /// Reports `load(s) = …` where nothing is called `s`: what ranges over all members says of which kind.
    fn unbound_state(&mut self, state: &'a ast::State, target: &'a ast::Ref) -> Option<()> {
        let params = state.params.as_ref().filter(|_| target.args.is_some())?;
        self.names_no_member(target, ("a state", &state.name, params), " in ")
    }

    fn state_line(&mut self, line: &'a ast::StartLine) -> Option<Vec<StartLine>> {
        let name = line.target.name.name.as_str();
        let state = match self.value_of(&line.target.name) {
            Some((Decl::State(state), _)) if self.unbound_state(state, &line.target).is_some() => {
                return None;
            }
            Some((Decl::State(state), _)) => state,
            // Its declaration is told.
            Some((Decl::Input(_), _)) if self.has_world => return None,
            Some((decl, _)) => {
                return self
                    .error(
                        Code::E0203,
                        line.target.span,
                        format!("a start cannot set `{name}`"),
                    )
                    .this_is(decl.what())
                    .none();
            }
            None => {
                let states = self.names.values(|decl| matches!(decl, Decl::State(_)));
                let likely = self.likely(name, states.chain(START_WORDS));
                return self.undeclared(&line.target.name, "state", likely).none();
            }
        };
        let (ty, variables) = self.state_variables(state, &line.target)?;
        let role = format!("`{name}`");
        let value = self.set_to(&line.target.name, &line.value, &ty, &role);
        let parts = self.held_parts(&value.value);
        if parts.is_empty() {
            return None;
        }
        match variables.as_slice() {
            [] => None,
            [(is, ids)] if self.program.pool.constant(*is) == Some(1.0) => {
                let set = ids.iter().copied().zip(parts);
                Some(vec![StartLine::State(set.collect())])
            }
            _ => {
                let target = ast::Expr {
                    kind: ast::ExprKind::Ref(line.target.clone()),
                    span: line.target.span,
                };
                let written = print::expr(&target);
                let block = self.set_meant(name, variables, &parts);
                Some(vec![StartLine::Member(written, block)])
            }
        }
    }
}
