//! `btc run --svg`: the beginning of an episode as a picture.

use super::load::Loaded;
use super::record;
use super::refused::Refused;
use super::run::Subject;
use crate::emit::svg;
use crate::emit::svg::track::{Stand, Track, TrackTick};
use crate::learn::simulated::Purpose;
use crate::report::words::end_names;
use crate::world::{End, Pose, Start};

/// Draws the world with the first `ticks` ticks of an episode of a seed, which [`run`](super::run::run) plays as well.
///
/// # Errors
/// As [`run`](super::run::run).
pub fn draw(
    loaded: &Loaded,
    subject: &Subject,
    (seed, episode): (u64, u64),
    ticks: u64,
) -> Result<String, Refused> {
    let program = &loaded.program;
    let id = subject.task(loaded)?;
    let task = &program.tasks[id];
    let begin = Start {
        episode,
        ..Purpose::Run.start(seed, task.end_after)
    };
    let name = match subject {
        Subject::Tree(tree) => format!("tree {}", program.trees[*tree].name),
        Subject::Policy(..) => "policy".to_owned(),
    };
    let (mut start, mut steps, mut end) = (None, Vec::new(), None);
    let robots = program.world.iter().flat_map(|world| world.others.values());
    let mut others: Vec<Vec<Stand>> = robots.map(|_| Vec::new()).collect();
    record::watch(loaded, subject, begin, &mut |_, simulation, done| {
        let stand = stand(simulation.pose());
        for (way, pose) in others.iter_mut().zip(simulation.others()) {
            way.push(self::stand(pose));
        }
        start.get_or_insert(stand);
        if let Some(done) = done {
            steps.push(TrackTick {
                behavior: done.behavior.map(|(behavior, _)| behavior),
                stand,
                events: simulation.fired().collect(),
            });
            end = done.tick.end;
        }
        (steps.len() as u64) < ticks
    })?;
    let Some(start) = start else {
        return Ok(String::new());
    };
    let track = Track {
        choices: task.choose.clone(),
        start,
        steps,
        others,
    };
    let which = match episode {
        0 => String::new(),
        episode => format!(", episode {episode}"),
    };
    let mut caption = format!("{name}, seed {seed}{which}, {} ticks", track.steps.len());
    if let Some(End::On(line)) = end
        && let Some(name) = end_names(program, task).get(line)
    {
        caption.push_str(&format!(", ended by {name}"));
    }
    let world = program.world.as_ref();
    Ok(world.map_or_else(String::new, |world| {
        svg::world::world(program, world, &caption, Some(&track))
    }))
}

fn stand(pose: Pose) -> Stand {
    Stand {
        position: pose.position,
        heading: pose.heading,
    }
}
