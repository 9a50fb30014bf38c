//! Pictures: what they show, that they are XML whatever the names are, and that nothing in them overlaps.

use crate::program::called;
use crate::snapshot::check;
use btc::driver::compile::Form;
use btc::driver::load::{Loaded, Reader, load};
use btc::driver::run::Subject;
use btc::driver::{compile, picture, target};
use btc::emit::form::TreeForm;
use btc::emit::svg;
use btc::emit::svg::curve::Point;
use btc::emit::svg::front::Dot;
use btc::emit::svg::layout::{Block, Placed, place};
use btc::ir::law::Behavior;
use btc::ir::tree::{Atom, Composite, Decorator, Guard, Node, Tree};
use btc::ir::{Id, Program};

/// The examples stand alone.
struct Nothing;

impl Reader for Nothing {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        Err(format!("{path} is not there"))
    }
}

fn example(name: &str) -> Loaded {
    let path = format!("{}/examples/{name}", env!("CARGO_MANIFEST_DIR"));
    let loaded = load(name, std::fs::read(path).unwrap(), &mut Nothing);
    assert!(!loaded.has_errors());
    loaded
}

fn tree(loaded: &Loaded) -> String {
    compile::emit(loaded, Form::Tree(TreeForm::Svg), Some("expert")).unwrap()
}

fn world(loaded: &Loaded, ticks: u64) -> String {
    played(loaded, "expert", ticks)
}

fn played(loaded: &Loaded, tree: &str, ticks: u64) -> String {
    let tree = target::tree(loaded, tree).unwrap();
    picture::draw(loaded, &Subject::Tree(tree), (1, 0), ticks).unwrap()
}

/// A curve that rises and settles.
fn curve() -> String {
    let point = |i: u64| {
        let rest = 1.0 / (1.0 + i as f64);
        Point {
            ticks: i * 125_000,
            mean: 52.0 - 70.0 * rest,
            interval: [50.0 - 84.0 * rest, 54.0 - 58.0 * rest],
            minterms: (i as usize + 1).min(10),
        }
    };
    let points: Vec<Point> = (0..=20).map(point).collect();
    svg::curve::curve(&points, "learned, seed 1", "95 % interval")
}

/// Parses a picture; every picture is called something and says what it shows.
fn parsed(picture: &str) -> roxmltree::Document<'_> {
    let document = roxmltree::Document::parse(picture).unwrap();
    for name in ["title", "desc"] {
        let note = document
            .root_element()
            .children()
            .find(|node| node.has_tag_name(("http://www.w3.org/2000/svg", name)));
        assert!(!note.unwrap().text().unwrap().is_empty(), "{picture}");
    }
    document
}

#[test]
fn the_pictures_of_small_delivery() {
    let loaded = example("delivery_small.bt");
    check("tree.expert.svg", &tree(&loaded));
    check("world.small.svg", &world(&loaded, 300));
    check("curve.svg", &curve());
}

#[test]
fn doors_are_dashed_and_other_robots_have_ways_of_their_own() {
    for (example_of, name, shown) in [
        ("rooms.bt", "world.rooms.svg", "class=\"wall dashed\""),
        ("guard.bt", "world.guard.svg", ">raider</text>"),
    ] {
        let picture = played(&example(example_of), "hand", 60);
        assert!(picture.contains(shown), "{picture}");
        check(name, &picture);
    }
}

#[test]
fn a_front_counts_whole_nodes() {
    let dot = |nodes: usize, mean: f64| Dot {
        nodes,
        mean,
        interval: [mean - 0.5, mean + 0.5],
        taken: nodes == 10,
    };
    check(
        "front.one.svg",
        &svg::front::front(&[dot(10, 9.0)], "learned", false),
    );
    let all = [dot(1, 2.0), dot(4, 5.0), dot(10, 9.0), dot(38, 9.25)];
    check("front.svg", &svg::front::front(&all, "learned", false));
    let proved = svg::front::front(&all, "learned", true);
    check("front.proved.svg", &proved);
}

#[test]
fn pictures_are_xml_and_the_same_each_time() {
    for name in ["delivery_small.bt", "delivery_large.bt"] {
        let (one, two) = (example(name), example(name));
        let pictures = |loaded| [tree(loaded), world(loaded, 700), curve()];
        assert_eq!(pictures(&one), pictures(&two));
        for picture in pictures(&one) {
            parsed(&picture);
        }
    }
}

/// The README's pictures are those of today's program. To make them anew:
///
/// ```text
/// btc compile examples/delivery_small.bt --emit svg --tree expert -o docs/tree.svg
/// btc run examples/delivery_large.bt --tree expert --svg docs/world.svg --svg-ticks 1000
/// ```
#[test]
fn the_pictures_of_the_readme_are_true() {
    for (name, picture) in [
        ("tree.svg", tree(&example("delivery_small.bt"))),
        ("world.svg", world(&example("delivery_large.bt"), 1000)),
    ] {
        let path = format!("{}/docs/{name}", env!("CARGO_MANIFEST_DIR"));
        let stored = std::fs::read_to_string(path).unwrap_or_default();
        assert!(
            stored == picture,
            "docs/{name} is out of date; the comment of this test says how it is made"
        );
    }
}

const HOSTILE: &str = "<a&b> \"c\" 'd' ]]> \u{1} é 木";
/// As XML can hold it.
const HELD: &str = "<a&b> \"c\" 'd' ]]> \u{fffd} é 木";

#[test]
fn every_name_is_escaped() {
    let mut loaded = example("delivery_large.bt");
    let program = &mut loaded.program;
    for id in program.behaviors.ids() {
        program.behaviors[id].name = HOSTILE.into();
    }
    for id in program.predicates.ids() {
        program.predicates[id].name = HOSTILE.into();
    }
    for id in program.events.ids() {
        program.events[id].name = HOSTILE.into();
    }
    for id in program.trees.ids() {
        program.trees[id].docs = vec![HOSTILE.to_owned()];
    }
    let scene = program.world.as_mut().unwrap();
    scene.name = HOSTILE.into();
    for id in scene.places.ids() {
        scene.places[id].name = HOSTILE.into();
    }
    for id in scene.walls.ids() {
        scene.walls[id].name = HOSTILE.into();
    }
    for id in scene.robot.sensors.ids() {
        scene.robot.sensors[id].name = HOSTILE.into();
    }
    let root = loaded.program.trees[target::tree(&loaded, "expert").unwrap()]
        .root
        .clone();
    let pictures = [
        svg::tree::tree(&loaded.program, &Tree::plain(HOSTILE.into(), root)),
        world(&loaded, 700),
        svg::curve::curve(&[], HOSTILE, HOSTILE),
    ];
    for picture in pictures {
        let document = parsed(&picture);
        let texts = document
            .descendants()
            .filter(|node| node.has_tag_name("text"));
        assert!(
            texts
                .filter_map(|node| node.text())
                .any(|text| text.contains(HELD))
        );
    }
}

#[test]
fn every_node_has_its_box() {
    let leaf = |behavior| Node::Behavior(Id::new(behavior));
    let decorated = |kind, node| Node::Decorator {
        kind,
        child: Box::new(node),
    };
    let root = Node::Parallel {
        successes: 2,
        children: vec![
            Node::Condition(Guard::Not(Box::new(Guard::Atom(Atom::Done(Id::new(2)))))),
            decorated(Decorator::Timeout(50), leaf(3)),
            decorated(Decorator::Invert, Node::Condition(Guard::Const(true))),
            Node::Composite {
                kind: Composite::Selector,
                memory: true,
                children: vec![decorated(Decorator::Retry(3), leaf(0)), leaf(1)],
            },
        ],
    };
    let mut program = Program::default();
    for name in ["goto(A)", "goto(B)", "goto(C)", "dock(C)"] {
        program.behaviors.push(Behavior {
            name: called(name),
            law: None,
        });
    }
    let picture = svg::tree::tree(&program, &Tree::plain("everything".into(), root));
    check("tree.everything.svg", &picture);
    let document = parsed(&picture);
    let titles = document
        .descendants()
        .filter(|node| node.has_tag_name("title"));
    let titles: Vec<_> = titles.filter_map(|node| node.text()).skip(1).collect();
    assert_eq!(
        titles,
        [
            "parallel 2",
            "condition not done(goto(C))",
            "decorator timeout 50 ticks",
            "behavior dock(C)",
            "decorator invert",
            "condition true",
            "memory selector",
            "decorator retry 3",
            "behavior goto(A)",
            "behavior goto(B)",
        ]
    );
}

#[test]
fn a_curve_without_a_point_or_with_one_is_a_picture() {
    let point = Point {
        ticks: 0,
        mean: 1.0,
        interval: [1.0, 1.0],
        minterms: 0,
    };
    let nothing = Point {
        mean: f64::NAN,
        ..point
    };
    for points in [&[][..], &[point], &[nothing], &[nothing, point, point]] {
        let picture = svg::curve::curve(points, "learned", "95 % interval");
        parsed(&picture);
        assert!(
            !picture.contains("NaN") && !picture.contains("inf"),
            "{picture}"
        );
    }
}

/// Numbers that look random.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 33) % sides
    }

    fn tree(&mut self, depth: u64, breadth: u64) -> Block {
        let children = if depth == 0 {
            0
        } else {
            self.roll(breadth + 1)
        };
        Block {
            width: (20 + 2 * self.roll(80)) as f64,
            height: (20 + 2 * self.roll(12)) as f64,
            children: (0..children)
                .map(|_| self.tree(depth - 1, breadth))
                .collect(),
        }
    }
}

fn mirrored(tree: &Block) -> Block {
    Block {
        children: tree.children.iter().rev().map(mirrored).collect(),
        ..*tree
    }
}

/// Checks that the boxes keep apart, within the picture, in their order.
fn check_layout(tree: &Block) {
    let (boxes, width, height) = place(tree);
    let overlap = |a: &Placed, b: &Placed| {
        (a.x - b.x).abs() < (a.width + b.width) / 2.0 + 8.0
            && (a.y - b.y).abs() < (a.height + b.height) / 2.0 + 8.0
    };
    for (i, a) in boxes.iter().enumerate() {
        assert!(
            a.x - a.width / 2.0 >= -1.0 && a.x + a.width / 2.0 <= width + 1.0,
            "{a:?}"
        );
        assert!(
            a.y >= a.height / 2.0 && a.y + a.height / 2.0 <= height,
            "{a:?}"
        );
        for b in &boxes[i + 1..] {
            assert!(!overlap(a, b), "{a:?} {b:?}");
            assert!(a.parent.is_none() || a.parent != b.parent || a.x < b.x);
        }
    }
}

#[test]
fn boxes_do_not_overlap() {
    let leaf = |width| Block {
        width,
        height: 30.0,
        children: Vec::new(),
    };
    let wide = Block {
        children: (0..200).map(|i| leaf(f64::from(20 + i % 7 * 30))).collect(),
        ..leaf(32.0)
    };
    let deep = (0..60).fold(leaf(80.0), |tree, i| Block {
        children: if i % 2 == 0 {
            vec![tree, leaf(60.0)]
        } else {
            vec![leaf(140.0), tree]
        },
        ..leaf(32.0)
    });
    let mut dice = Dice(7);
    let random = (0..300).map(|i| dice.tree(1 + i % 7, 2 + i % 4));
    for tree in random.chain([wide, deep, leaf(10.0)]) {
        check_layout(&tree);
    }
}

#[test]
fn the_mirror_image_of_a_tree_is_laid_out_as_its_mirror_image() {
    let mut dice = Dice(11);
    for i in 0..50 {
        let tree = dice.tree(1 + i % 6, 3);
        let (boxes, width, _) = place(&tree);
        let (mirror, same_width, _) = place(&mirrored(&tree));
        assert!((width - same_width).abs() < 1e-6);
        let mut xs: Vec<f64> = boxes.iter().map(|b| b.x).collect();
        let mut others: Vec<f64> = mirror.iter().map(|b| width - b.x).collect();
        xs.sort_by(f64::total_cmp);
        others.sort_by(f64::total_cmp);
        for (x, other) in xs.iter().zip(&others) {
            // Each is rounded to a whole px.
            assert!((x - other).abs() <= 1.0 + 1e-6, "{x} {other}");
        }
    }
}
