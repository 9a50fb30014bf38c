//! What a program could ask of its world, as the language writes it.

use crate::driver::load::Loaded;
use crate::ir::program::ValueKind;
use crate::ir::tunable::Unit;
use crate::source::FileId;
use crate::syntax::ast::ItemKind;
use std::f64::consts::PI;

/// Something to ask.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reading {
    /// The expression.
    pub(super) text: String,
    /// How its values are to be read.
    pub(super) kind: Kind,
}

/// How the values of a reading are to be read.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// It holds, or it does not.
    Truth,
    /// A state variable, whose values have this unit.
    State(usize, Unit),
    /// A number in this unit, in a range.
    Within([f64; 2], Unit),
}

/// Everything that could be asked, as far as the checker lets predicates ask it.
pub(super) fn readings(loaded: &Loaded) -> Vec<Reading> {
    let offered = offered(loaded);
    // What the checker refuses is no reading, or not in this unit.
    let lines: Vec<String> = offered
        .iter()
        .enumerate()
        .map(|(at, reading)| format!("predicate btc_{at} = {}\n", reading.tried()))
        .collect();
    let refused = refused(loaded, &lines);
    let mut readings: Vec<Reading> = Vec::new();
    for (reading, refused) in offered.into_iter().zip(refused) {
        // Of the units that a value could have, the first stands.
        let known = readings.iter().any(|known| known.text == reading.text);
        if !refused && !known {
            readings.push(reading);
        }
    }
    readings
}

/// Which of some lines of items have a mistake.
pub(super) fn refused(loaded: &Loaded, lines: &[String]) -> Vec<bool> {
    let (_, mistakes) = loaded.extended(&lines.concat());
    let mut refused = vec![false; lines.len()];
    for mistake in &mistakes {
        let mut left = mistake.span().start as usize;
        for (line, refused) in lines.iter().zip(&mut refused) {
            if left < line.len() {
                *refused = true;
                break;
            }
            left -= line.len();
        }
    }
    refused
}

impl Reading {
    /// A condition on it that any value can be put into.
    fn tried(&self) -> String {
        match &self.kind {
            Kind::Truth => self.text.clone(),
            Kind::State(_, unit) | Kind::Within(_, unit) => {
                format!("{} <= {}", self.text, unit.written(1.0))
            }
        }
    }
}

fn unit(text: &str, times: f64, over: f64) -> Unit {
    Unit {
        text: text.to_owned(),
        times,
        over,
    }
}

/// All readings, each in every unit that may be its own.
fn offered(loaded: &Loaded) -> Vec<Reading> {
    let program = &loaded.program;
    let mut offered = Vec::new();
    let mut offer = |text: String, kind: Kind| offered.push(Reading { text, kind });
    for (id, state) in program.states.iter() {
        let name = state.name.to_string();
        match &state.kind {
            ValueKind::Bool => offer(name, Kind::Truth),
            ValueKind::Enum(variants) => {
                for variant in variants {
                    offer(format!("{name} == {variant}"), Kind::Truth);
                }
            }
            ValueKind::Quantity => {
                let plain = match is_ratio(loaded, &state.name.family) {
                    true => unit("%", 1.0, 100.0),
                    false => unit("", 1.0, 1.0),
                };
                let units = [
                    plain,
                    unit("m", 1.0, 1.0),
                    unit("s", 1.0, 1.0),
                    unit("deg", PI, 180.0),
                    unit("m/s", 1.0, 1.0),
                    unit("rad/s", 1.0, 1.0),
                ];
                for unit in units {
                    offer(name.clone(), Kind::State(id.index(), unit));
                }
            }
        }
    }
    let Some(world) = &program.world else {
        return offered;
    };
    let (low, high) = world.arena.bounds();
    let metres = |range| Kind::Within(range, unit("m", 1.0, 1.0));
    let [width, height] = [high[0] - low[0], high[1] - low[1]];
    let diagonal = (width * width + height * height).sqrt();
    let far = || metres([0.0, diagonal]);
    let aside = || Kind::Within([0.0, 180.0], unit("deg", PI, 180.0));
    for place in world.places.values() {
        let name = &place.name;
        offer(format!("inside({name})"), Kind::Truth);
        offer(format!("distance({name})"), far());
        offer(format!("visible({name})"), Kind::Truth);
        offer(format!("abs(bearing({name}))"), aside());
    }
    for other in world.others.values() {
        let name = &other.robot.name;
        offer(format!("distance({name})"), far());
        offer(format!("visible({name})"), Kind::Truth);
        offer(format!("abs(bearing({name}))"), aside());
    }
    for sensor in world.robot.sensors.values() {
        let name = &sensor.name;
        offer(format!("visible({name})"), Kind::Truth);
        offer(format!("distance({name})"), far());
        offer(format!("abs(bearing({name}))"), aside());
    }
    offer("distance(nearest_wall)".to_owned(), far());
    offer("touching".to_owned(), Kind::Truth);
    offer("position.x".to_owned(), metres([low[0], high[0]]));
    offer("position.y".to_owned(), metres([low[1], high[1]]));
    offered
}

/// Whether a state is declared as a ratio, or with one.
fn is_ratio(loaded: &Loaded, name: &str) -> bool {
    let items = loaded.asts().flat_map(|ast| &ast.items);
    let mut states = items.filter_map(|item| match &item.kind {
        ItemKind::State(state) if state.name.name == name => Some(state),
        _ => None,
    });
    states.any(|state| {
        let said = state.ty.as_ref().map_or(state.value.span, |ty| ty.span);
        let said = loaded.sources.text(said);
        said.contains("ratio") || said.contains('%')
    })
}

/// Whether a word stands in a text of the user.
pub(super) fn is_taken(loaded: &Loaded, name: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let texts = |id: &FileId| loaded.sources.get(*id).map(|source| source.text.as_str());
    let mut texts = loaded.files.iter().filter_map(texts);
    texts.any(|text| text.split(|c| !is_part(c)).any(|word| word == name))
}
