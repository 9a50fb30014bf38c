//! What one tick runs, compiled.

use super::atoms::Atoms;
use super::error::BuildError;
use crate::eval::{Code, Compiler, Fixed, Folding, Label, Layout, TooLarge};
use crate::ir::law::{Behavior, Block, Law, Stmt};
use crate::ir::task::{StartLine, Task};
use crate::ir::{Expr, ExprId, Id, Pool, Program};

/// The compiled program of a task.
#[derive(Clone, Debug)]
pub(super) struct Programs {
    /// What every tick does.
    pub(super) each_tick: Code,
    /// The behaviours.
    pub(super) routines: Vec<Routine>,
    /// The end of a tick in which nothing has terminated. Answers 1, without having changed anything, where an event
    /// happens nevertheless.
    pub(super) quiet: Code,
    /// The end of any tick.
    pub(super) full: Code,
    /// The predicates alone.
    pub(super) predicates: Code,
    /// The lists of start lines.
    pub(super) starts: Vec<Vec<Step>>,
    /// The reward of a tick without events where it is always the same.
    pub(super) otherwise: Option<f64>,
}

/// A behaviour.
#[derive(Clone, Debug)]
pub(super) struct Routine {
    /// Sets its variables.
    pub(super) begin: Code,
    /// Its tick.
    pub(super) tick: Code,
    /// Whether it asks how long it has run.
    pub(super) timed: bool,
}

/// A step of an episode's start.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// Any free pose.
    Anywhere,
    /// Sets the position or the heading.
    Place(Code),
    /// Sets a state.
    Set(Code),
    /// Sets the newest termination.
    Remember(Code),
}

/// The answer of the quiet end where it does not apply.
pub(super) const NOT_QUIET: u16 = 1;

impl Programs {
    /// Compiles a task. `open`: nothing can come between the robot and what it looks at.
    pub(super) fn compile(
        program: &Program,
        task: &Task,
        starts: &[&[StartLine]],
        atoms: &Atoms,
        open: bool,
        layout: &mut Layout,
    ) -> Result<Self, BuildError> {
        let mut pool = program.pool.clone();
        let ending = Ending::new(program, task, atoms, &mut pool)?;
        let mut sight = Folding::new(&mut pool, |expr| match expr {
            Expr::Visible(..) if open => Some(true),
            _ => None,
        });
        let ending = ending.fold(&mut sight);
        let each_tick = sight.block(&program.each_tick);
        let laws: Vec<_> = program
            .behaviors
            .values()
            .map(|behavior| behavior.law.as_ref().map(|law| sight.law(law)))
            .collect();
        let nothing = ending.fold(&mut Folding::new(&mut pool, |expr| match expr {
            Expr::Ended(..) | Expr::Event(_) => Some(false),
            _ => None,
        }));

        let otherwise = pool.constant(nothing.otherwise);
        let predicates = piece(&pool, layout, |c| ending.read_predicates(c))?;
        let full = piece(&pool, layout, |c| ending.compile(c))?;
        let quiet = piece(&pool, layout, |c| {
            nothing.compile_quiet(otherwise.is_none(), c)
        })?;
        let each_tick = piece(&pool, layout, |c| c.block(&each_tick))?;
        let routines = laws
            .iter()
            .zip(program.behaviors.ids())
            .map(|(law, id)| match law {
                Some(law) => routine(&pool, layout, id, law),
                None => Ok(Routine {
                    begin: Code::default(),
                    tick: piece(&pool, layout, |c| {
                        c.fail();
                        Ok(())
                    })?,
                    timed: false,
                }),
            })
            .collect::<Result<_, TooLarge>>()?;
        let starts = starts
            .iter()
            .map(|lines| start(&pool, layout, lines))
            .collect::<Result<_, TooLarge>>()?;
        Ok(Self {
            each_tick,
            routines,
            quiet,
            full,
            predicates,
            starts,
            otherwise,
        })
    }
}

/// The end of a tick: steps 5 to 8.
#[derive(Clone, Debug)]
struct Ending {
    events: Vec<ExprId>,
    /// Whether a rewarded event fires.
    closed: ExprId,
    /// The number of the line of `end on` that fires, counted from one.
    end: ExprId,
    reward: ExprId,
    otherwise: ExprId,
    effects: Block,
    predicates: Vec<(u16, ExprId)>,
}

impl Ending {
    fn new(
        program: &Program,
        task: &Task,
        atoms: &Atoms,
        pool: &mut Pool,
    ) -> Result<Self, BuildError> {
        let mut closed = pool.bool(false);
        let mut reward = task.otherwise;
        for line in task.reward.iter().rev() {
            closed = pool.or(line.event, closed);
            reward = pool.select(line.event, line.value, reward);
        }
        let mut end = pool.num(0.0);
        for (i, &line) in task.end_on.iter().enumerate().rev() {
            let number = pool.num((i + 1) as f64);
            end = pool.select(line, number, end);
        }
        // What effects depend on is looked at before the first of them. A plain event has been already, and folds
        // where it cannot happen; any other condition is kept under a name.
        let (mut conditions, mut effects) = (Vec::new(), Vec::new());
        for (i, effect) in program.effects.iter().enumerate() {
            let mut condition = effect.on;
            if !matches!(pool.get(condition), Expr::Event(_)) {
                let name = Id::new(program.temps.len() + i);
                conditions.push(Stmt::Let(name, condition));
                condition = pool.leaf(Expr::Temp(name));
            }
            effects.push(Stmt::If(condition, effect.block.clone(), Block::default()));
        }
        conditions.append(&mut effects);
        let predicates = atoms
            .predicates()
            .map(|(bit, id)| {
                let predicate = &program.predicates[id];
                let when = predicate.when;
                when.map(|when| (bit, when))
                    .ok_or_else(|| BuildError::Declared(predicate.name.clone()))
            })
            .collect::<Result<_, _>>()?;
        Ok(Self {
            events: program.events.values().map(|event| event.when).collect(),
            closed,
            end,
            reward,
            otherwise: task.otherwise,
            effects: Block(conditions),
            predicates,
        })
    }

    fn fold<F: Fn(Expr) -> Option<bool>>(&self, folding: &mut Folding<'_, F>) -> Self {
        Self {
            events: self.events.iter().map(|&id| folding.expr(id)).collect(),
            closed: folding.expr(self.closed),
            end: folding.expr(self.end),
            reward: folding.expr(self.reward),
            otherwise: folding.expr(self.otherwise),
            effects: folding.block(&self.effects),
            predicates: self
                .predicates
                .iter()
                .map(|&(bit, id)| (bit, folding.expr(id)))
                .collect(),
        }
    }

    fn read_predicates(&self, compiler: &mut Compiler<'_>) -> Result<(), TooLarge> {
        self.predicates
            .iter()
            .try_for_each(|&(bit, id)| compiler.atom(bit, id))
    }

    /// Everything, in order.
    fn compile<'a>(&'a self, compiler: &mut Compiler<'a>) -> Result<(), TooLarge> {
        for (i, &when) in self.events.iter().enumerate() {
            compiler.event(Id::new(i), when)?;
        }
        compiler.assign(Fixed::Closed.register(), self.closed)?;
        compiler.assign(Fixed::Reward.register(), self.reward)?;
        compiler.assign(Fixed::End.register(), self.end)?;
        compiler.block(&self.effects)?;
        self.read_predicates(compiler)
    }

    /// What is left where nothing has terminated and no event happens.
    fn compile_quiet<'a>(
        &'a self,
        rewards: bool,
        compiler: &mut Compiler<'a>,
    ) -> Result<(), TooLarge> {
        let mut happens = Label::default();
        for &when in &self.events {
            compiler.jump_where(when, true, &mut happens)?;
        }
        compiler.jump_where(self.closed, true, &mut happens)?;
        compiler.jump_where(self.end, true, &mut happens)?;
        if rewards {
            compiler.assign(Fixed::Reward.register(), self.otherwise)?;
        }
        compiler.block(&self.effects)?;
        self.read_predicates(compiler)?;
        if happens.is_used() {
            compiler.exit(0);
            compiler.bind(happens);
            compiler.exit(NOT_QUIET);
        }
        Ok(())
    }
}

fn piece<'a>(
    pool: &'a Pool,
    layout: &'a mut Layout,
    fill: impl FnOnce(&mut Compiler<'a>) -> Result<(), TooLarge>,
) -> Result<Code, TooLarge> {
    let mut compiler = Compiler::new(pool, layout, None);
    fill(&mut compiler)?;
    compiler.finish()
}

fn routine(
    pool: &Pool,
    layout: &mut Layout,
    id: Id<Behavior>,
    law: &Law,
) -> Result<Routine, TooLarge> {
    let mut begin = Compiler::new(pool, layout, Some(id));
    begin.locals(law)?;
    let begin_timed = begin.is_timed();
    let begin = begin.finish()?;
    let mut tick = Compiler::new(pool, layout, Some(id));
    tick.law(law)?;
    Ok(Routine {
        begin,
        timed: begin_timed || tick.is_timed(),
        tick: tick.finish()?,
    })
}

fn start(pool: &Pool, layout: &mut Layout, lines: &[StartLine]) -> Result<Vec<Step>, TooLarge> {
    let has = |test: fn(&StartLine) -> bool| lines.iter().any(test);
    let placed = has(|line| matches!(line, StartLine::Anywhere))
        || has(|line| matches!(line, StartLine::Position(..)))
            && has(|line| matches!(line, StartLine::Heading(_)));
    // What the lines leave open of the pose is drawn before them.
    let mut steps = if placed {
        Vec::new()
    } else {
        vec![Step::Anywhere]
    };
    for line in lines {
        let mut compiler = Compiler::new(pool, layout, None);
        let step: fn(Code) -> Step = match *line {
            StartLine::Anywhere => {
                steps.push(Step::Anywhere);
                continue;
            }
            StartLine::Position(x, y) => {
                compiler.assign_all(&[(Fixed::X.register(), x), (Fixed::Y.register(), y)])?;
                Step::Place
            }
            StartLine::Heading(heading) => {
                compiler.assign_all(&[(Fixed::Heading.register(), heading)])?;
                Step::Place
            }
            StartLine::State(state, value) => {
                compiler.block(&Block(vec![Stmt::SetState(state, value)]))?;
                Step::Set
            }
            StartLine::History(code) => {
                compiler.assign_all(&[(Fixed::History.register(), code)])?;
                Step::Remember
            }
        };
        steps.push(step(compiler.finish()?));
    }
    Ok(steps)
}
