//! `start`: what an episode begins with.

use crate::check::Checker;
use crate::check::context::{Context, Region};
use crate::check::names::{Decl, START_WORDS};
use crate::check::types::{Type, Value};
use crate::diagnostic::Code;
use crate::ir::task::{History, StartLine};
use crate::syntax::ast;

impl<'a> Checker<'a> {
    /// `start { … }`, for a task that keeps this history.
    pub fn start(&mut self, start: &'a ast::Start, history: Option<History>) -> Vec<StartLine> {
        self.context = Context::new(Region::Start);
        self.kept = history;
        let mut lines: Vec<StartLine> = Vec::new();
        let mut set: Vec<&ast::Ident> = Vec::new();
        for line in &start.lines {
            let built = self.start_line(line);
            let name = &line.target.name;
            match set.iter().find(|first| first.name == name.name) {
                Some(first) => self
                    .error(
                        Code::E0503,
                        name.span,
                        format!("`{}` is set twice", name.name),
                    )
                    .label("this line would undo the first")
                    .also(first.span, "first set here")
                    .emit(),
                None => set.push(name),
            }
            lines.extend(built.into_iter().flatten());
        }
        self.kept = None;
        lines
    }

    fn start_line(&mut self, line: &'a ast::StartLine) -> Option<Vec<StartLine>> {
        self.context.region = Region::Start;
        let value = &line.value;
        match line.target.name.name.as_str() {
            "pose" => {
                let value = self.expr(value);
                if !value.ty.fits(&Type::Anywhere) {
                    self.error(Code::E0302, value.span, "`pose` is `anywhere`")
                        .this_is(&value.ty)
                        .help("a pose of your own: `position = (1 m, 2 m)`, `heading = 90 deg`");
                }
                Some(vec![StartLine::Anywhere])
            }
            "position" => match self.expect(value, &Type::Point, "`position`").value {
                Value::Point(x, y) => {
                    let constant = |id| self.program.pool.constant(id);
                    if let (Some(x), Some(y)) = (constant(x), constant(y)) {
                        self.positions.push((value.span, [x, y]));
                    }
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
                let value = self.expr(value);
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

    fn state_line(&mut self, line: &'a ast::StartLine) -> Option<Vec<StartLine>> {
        let name = line.target.name.name.as_str();
        let state = match self.names.value(name, false) {
            Some((Decl::State(state), _)) => state,
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
        let ty = self.state_value(state, &line.target)?.ty;
        let value = self.expect(&line.value, &ty, &format!("`{name}`"));
        let parts = value.value.parts();
        if parts.is_empty() {
            return None;
        }
        let states = self.state_variables(name).into_iter();
        Some(
            states
                .zip(parts)
                .map(|(id, part)| StartLine::State(id, part))
                .collect(),
        )
    }
}
