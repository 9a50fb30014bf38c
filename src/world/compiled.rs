//! The code of a task: what its episodes and ticks run.

use super::atoms::Atoms;
use super::door::{self, Door};
use super::ending::{End, Ending};
use super::error::BuildError;
use super::start::StartStep;
use crate::eval::{Code, Compiler, Folding, Layout, TooLarge};
use crate::ir::law::{Behavior, Block, Law};
use crate::ir::task::{StartLine, Task};
use crate::ir::tree::Status;
use crate::ir::{Expr, Id, Pool, Program};

/// The code of a task.
#[derive(Clone, Debug)]
pub(super) struct Compiled {
    /// What every tick does.
    pub(super) each_tick: Code,
    /// The behaviours.
    pub(super) routines: Vec<Routine>,
    /// The end of a tick in which nothing has terminated. If an event happens nevertheless it changes nothing and answers
    /// [`NOT_QUIET`](super::ending::NOT_QUIET).
    pub(super) quiet: Code,
    /// The end of any tick.
    pub(super) full: Code,
    /// The predicates alone.
    pub(super) predicates: Code,
    /// Which doors are to stand. Where there are any, the end of a tick leaves the predicates to [`Compiled::predicates`],
    /// which sees the doors as they stand after it.
    pub(super) doors: Code,
    /// The lists of start lines.
    pub(super) starts: Vec<Vec<StartStep>>,
    /// The reward of a tick without events where it is always the same.
    pub(super) otherwise: Option<f64>,
    /// What a tick pays, whatever happens in it, where that is always the same.
    pub(super) flow: Option<f64>,
    /// What the reward says that each line of `end on` is worth.
    pub(super) worths: Vec<Option<f64>>,
}

/// A behaviour.
#[derive(Clone, Debug)]
pub(super) struct Routine {
    /// Sets its variables.
    pub(super) begin: Code,
    /// Its tick.
    pub(super) tick: Code,
    /// What every tick does, and then its tick; none if the two cannot be one.
    pub(super) again: Option<Code>,
    /// Whether it asks how long it has run.
    pub(super) timed: bool,
}

impl Compiled {
    /// Compiles a task. `open`: nothing can come between the robot and what it looks at.
    pub(super) fn new(
        program: &Program,
        task: &Task,
        starts: &[&[StartLine]],
        atoms: &Atoms,
        open: bool,
        doors: &[Door],
        layout: &mut Layout,
    ) -> Result<Self, BuildError> {
        if doors.len() > door::MOST {
            return Err(BuildError::TooManyDoors(doors.len()));
        }
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
            Expr::Ended(_, Status::Running) => None,
            Expr::Ended(..) | Expr::Event(_) => Some(false),
            _ => None,
        }));

        let otherwise = pool.constant(nothing.otherwise);
        let flow = pool.constant(ending.flow);
        let flows = flow.is_none();
        let predicates = piece(&pool, layout, |c| ending.read_predicates(c))?;
        let end = End {
            rewards: otherwise.is_none(),
            flows,
            reads: doors.is_empty(),
        };
        let full = piece(&pool, layout, |c| ending.compile(end, c))?;
        let quiet = piece(&pool, layout, |c| nothing.compile_quiet(end, c))?;
        let doors = piece(&pool, layout, |c| {
            Door::read(doors.iter().map(|door| door.when), c)
        })?;
        let routines = laws
            .iter()
            .zip(program.behaviors.ids())
            .map(|(law, id)| match law {
                Some(law) => routine(&pool, layout, id, law, &each_tick),
                None => Ok(Routine {
                    again: None,
                    begin: Code::default(),
                    tick: piece(&pool, layout, |c| {
                        c.fail();
                        Ok(())
                    })?,
                    timed: false,
                }),
            })
            .collect::<Result<_, TooLarge>>()?;
        let others = program.world.as_ref();
        let others = others.map_or(0, |world| world.others.len());
        let starts = starts
            .iter()
            .map(|lines| StartStep::list(&pool, layout, lines, others))
            .collect::<Result<_, TooLarge>>()?;
        let each_tick = piece(&pool, layout, |c| c.block(&each_tick))?;
        Ok(Self {
            each_tick,
            routines,
            quiet,
            full,
            predicates,
            doors,
            starts,
            otherwise,
            flow,
            worths: task.worths(program),
        })
    }
}

impl Compiled {
    /// All of its code that episodes run in their ticks.
    pub(super) fn codes(&self) -> impl Iterator<Item = &Code> + Clone {
        let routines = self.routines.iter();
        let routines = routines.flat_map(|routine| {
            [&routine.begin, &routine.tick]
                .into_iter()
                .chain(&routine.again)
        });
        [
            &self.each_tick,
            &self.quiet,
            &self.full,
            &self.predicates,
            &self.doors,
        ]
        .into_iter()
        .chain(routines)
    }
}

pub(super) fn piece<'a>(
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
    each_tick: &Block,
) -> Result<Routine, TooLarge> {
    let mut begin = Compiler::new(pool, layout, Some(id));
    begin.locals(law)?;
    let begin_timed = begin.is_timed();
    let begin = begin.finish()?;
    let mut tick = Compiler::new(pool, layout, Some(id));
    tick.law(law)?;
    let timed = begin_timed || tick.is_timed();
    let tick = tick.finish()?;
    let mut again = Compiler::new(pool, layout, Some(id));
    again.block(each_tick)?;
    // How long a behaviour has run is said after what every tick does.
    let apart = again.is_timed();
    again.law(law)?;
    let again = again.finish()?;
    Ok(Routine {
        begin,
        tick,
        again: (!apart).then_some(again),
        timed,
    })
}
