//! Covers are 1 and 0 where the PLA says so, and a PLA that is written is one that can be read.

use btc::diagnostic::render;
use btc::driver::Text;
use btc::driver::minimize::{Minimized, Options, Order, minimize};
use btc::logic::packed::Packed;
use btc::logic::pla::{Kind, Part, Pla, read};

/// The most inputs, outputs and rows that are enumerated.
const SMALL: [usize; 3] = [8, 4, 64];

/// The law.
pub fn holds(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let Ok(before) = read(&text) else {
        assert!(run(&text, None).is_err());
        return;
    };
    let size = [before.inputs, before.outputs, before.rows()];
    if size.iter().zip(SMALL).any(|(is, most)| *is > most) {
        return;
    }
    covers(&text, &before);
    for order in [Order::Learned, Order::Given, Order::Rarest] {
        if let Ok(found) = run(&text, Some(order)) {
            decides(&before, &read(&found.text).unwrap(), &text);
        }
    }
}

/// What `btc minimize` makes of a text, or what it shows of its mistakes.
pub(crate) fn run(text: &str, order: Option<Order>) -> Result<Minimized, String> {
    minimised(text, order, false)
}

/// As [`run`], each output by itself.
pub(crate) fn separately(text: &str) -> Result<Minimized, String> {
    minimised(text, None, true)
}

fn minimised(text: &str, order: Option<Order>, separate: bool) -> Result<Minimized, String> {
    let options = Options {
        order,
        limit: 1_000,
        separate,
    };
    let text = Text {
        name: "test.pla",
        bytes: text.as_bytes(),
    };
    minimize(text, &options)
        .map_err(|refused| render::human(&refused.sources, &refused.diagnostics, false))
}

/// The covers agree with what was said; there are none where that contradicts itself.
pub(crate) fn covers(text: &str, before: &Pla) {
    let contradicts = (0..before.outputs).any(|output| {
        (0..1 << before.inputs)
            .any(|m| says(before, m, output, Part::On) && says(before, m, output, Part::Off))
    });
    match run(text, None) {
        Err(said) => assert!(contradicts && said.contains("E0805"), "{text}{said}"),
        Ok(found) => {
            assert!(!contradicts, "{text}");
            agrees(before, &read(&found.text).unwrap(), text);
        }
    }
}

fn says(pla: &Pla, minterm: u64, output: usize, part: Part) -> bool {
    let point = Packed::new(pla.inputs, &[minterm], &[]);
    (0..pla.rows()).any(|row| pla.part(row, output) == part && pla.cube(row).contains(&point))
}

fn agrees(before: &Pla, after: &Pla, text: &str) {
    let given = matches!(before.kind, Kind::Fr | Kind::Fdr);
    for minterm in 0..1 << before.inputs {
        for output in 0..before.outputs {
            let was = |part| says(before, minterm, output, part);
            let holds = says(after, minterm, output, Part::On);
            let free = was(Part::Free) || (given && !was(Part::On) && !was(Part::Off));
            assert!(
                free || holds == was(Part::On),
                "{minterm:b} of {output}\n{text}"
            );
            assert!(!holds || !was(Part::Off), "{minterm:b} of {output}\n{text}");
        }
    }
}

/// The first row of a decision list that holds of a minterm has the output that was said.
fn decides(before: &Pla, list: &Pla, text: &str) {
    for minterm in 0..1 << before.inputs {
        let point = Packed::new(before.inputs, &[minterm], &[]);
        let first = (0..list.rows()).find(|row| list.cube(*row).contains(&point));
        for output in 0..before.outputs {
            if says(before, minterm, output, Part::On) {
                let decided = first.map(|row| list.part(row, output));
                assert_eq!(decided, Some(Part::On), "{minterm:b} of {output}\n{text}");
            }
        }
    }
}
