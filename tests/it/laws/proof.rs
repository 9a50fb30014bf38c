//! The proof that two trees are equal, or the shortest trace on which they part, beside plain enumeration.

use super::grown::Soil;
use super::lockstep::Lockstep;
use super::random::Random;
use btc::ir::task::History;
use btc::ir::tree::Node;
use btc::tree::Size;
use btc::tree::drawing::{Drawing, Shape};
use btc::tree::equivalence::{Environment, Onward, Side, Verdict, compare_onward};
use btc::tree::prune::asked_once;

/// The most states that are enumerated.
const STATES: usize = 400;

/// The law: the bytes are the choices by which two trees grow.
pub fn holds(bytes: &[u8]) {
    let random = &mut Random::given(bytes);
    let soil = Soil {
        predicates: 1 + random.below(3),
        behaviors: 2 + random.below(2),
        history: random.chance(40),
        memory: random.chance(60),
        wild: true,
    };
    let history = History {
        window: random.below(3),
        success: random.chance(80),
        failure: random.chance(60),
    };
    let left = soil.tree(random, 3);
    // The other half of the bytes, most of which stay as they are where one of the first changes.
    let random = &mut Random::given(bytes.split_at(bytes.len() / 2).1);
    let right = soil.tree(random, 3);
    agrees(&left, &right, history);
    agrees(&left, &left, history);
    assert_eq!(Size::of(&left), drawn(&Drawing::of(&left)), "{left:?}");
    let once = asked_once(&left);
    assert!(Size::of(&once).nodes <= Size::of(&left).nodes);
    if let Some((verdict, onward)) = agrees(&left, &once, history) {
        assert!(matches!(verdict, Verdict::Equal(_)), "{left:?}\n{once:?}");
        assert!(matches!(onward, Onward::Alike), "{left:?}\n{once:?}");
    }
}

/// The size of a tree as it is drawn.
fn drawn(drawing: &Drawing) -> Size {
    let own = Size {
        nodes: 1,
        literals: usize::from(matches!(drawing.shape, Shape::Literal(..))),
        depth: 1,
    };
    drawing.children.iter().fold(own, |all, child| {
        let below = drawn(child);
        Size {
            nodes: all.nodes + below.nodes,
            literals: all.literals + below.literals,
            depth: all.depth.max(below.depth + 1),
        }
    })
}

/// The verdict, where enumeration ends; it is that of enumeration, and so is how the trees go on where all may end in any way.
pub(crate) fn agrees(left: &Node, right: &Node, history: History) -> Option<(Verdict, Onward)> {
    let both = Lockstep::new(left, right, history);
    let expected = both.parts(STATES)?;
    let environment = Environment::Any(history);
    let sides = [left, right].map(Side::Tree);
    let (found, onward) = compare_onward(sides[0], sides[1], environment, &|_, _| true).unwrap();
    match (&found, expected) {
        (Verdict::Equal(_), None) => {
            let expected = both.goes_on_differently();
            match &onward {
                Onward::Alike => assert_eq!(expected, None, "{left:?}\n{right:?}"),
                Onward::Differ(parted) => {
                    assert_eq!(Some(parted.trace.steps.len()), expected);
                    both.replay_onward(parted);
                }
                Onward::Undecided => panic!("undecided: {left:?}\n{right:?}"),
            }
        }
        (Verdict::Differ(trace), Some((depth, least))) => {
            assert_eq!(trace.steps.len(), depth, "{left:?}\n{right:?}");
            // Counters part trees later, too.
            if depth == 0 && !left.remembers() && !right.remembers() {
                assert_eq!(Some(&trace.valuation), least.as_ref());
            }
            both.replay(trace);
        }
        found => panic!("{found:?}\n{left:?}\n{right:?}"),
    }
    Some((found, onward))
}
