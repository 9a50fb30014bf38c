//! A tree, drawn in layers.
//!
//! → is a sequence, ? a selector, a star means memory, ⇉ is `parallel`; conditions are ovals, behaviours boxes,
//! decorators diamonds (the paper's Figure 1). Guards are drawn as [`Drawing`] has them.

use super::layout::{self, Block, Placed};
use super::page::{self, Head, Page, number};
use super::paint::{Rule, rule};
use crate::emit::bt;
use crate::ir::Program;
use crate::ir::tree::{Composite, Tree};
use crate::tree::drawing::{Drawing, Shape};

/// Around the tree.
const MARGIN: f64 = 20.0;
/// The height of a leaf.
const LEAF: f64 = 30.0;
/// The side of a composite's square.
const SQUARE: f64 = 32.0;

const RULES: &[Rule] = &[
    rule("edge", "fill:none;stroke:#90a0ab", "stroke:#5f6f7b"),
    rule(
        "control",
        "fill:#eef1f4;stroke:#8496a3",
        "fill:#222b34;stroke:#6f8291",
    ),
    rule(
        "condition",
        "fill:#fff5dc;stroke:#d9a441",
        "fill:#33290f;stroke:#b98a2e",
    ),
    rule(
        "behavior",
        "fill:#e0f2e4;stroke:#62a873",
        "fill:#15301e;stroke:#4c9460",
    ),
    rule(
        "decorator",
        "fill:#efe9fa;stroke:#9a82cc",
        "fill:#292140;stroke:#8069b5",
    ),
    rule(
        "symbol",
        "fill:none;stroke:#37474f;stroke-width:1.5;stroke-linecap:round;stroke-linejoin:round",
        "stroke:#d5dee6",
    ),
    rule("sign", "font-size:17px;font-weight:600", ""),
];

/// A tree as a picture; its description is the tree in the language.
pub fn tree(program: &Program, tree: &Tree) -> String {
    let drawing = Drawing::of(&tree.root);
    let plain = Tree::plain(tree.name.clone(), tree.root.clone());
    let (placed, width, height) = layout::place(&block(&drawing, program));
    let mut page = Page::new(&Head {
        class: "btc-tree",
        width: (width + 2.0 * MARGIN).ceil(),
        height: (height + 2.0 * MARGIN).ceil(),
        title: &format!("behaviour tree {}", tree.name),
        description: &bt::tree(program, &plain),
        rules: RULES,
    });
    // Strokes of one px are crisp when they run between the whole numbers.
    let middle = format!("translate({} {})", MARGIN + 0.5, MARGIN + 0.5);
    page.open("g", &[("transform", middle.into())]);
    for child in &placed {
        if let Some(parent) = child.parent.and_then(|parent| placed.get(parent)) {
            page.path("edge", edge(parent, child));
        }
    }
    let mut shapes = Vec::new();
    list(&drawing, &mut shapes);
    for (shape, place) in shapes.into_iter().zip(&placed) {
        draw(shape, place, program, &mut page);
    }
    page.finish()
}

/// The shapes in pre-order.
fn list(drawing: &Drawing, shapes: &mut Vec<Shape>) {
    shapes.push(drawing.shape);
    for child in &drawing.children {
        list(child, shapes);
    }
}

/// The space that a tree takes.
fn block(drawing: &Drawing, program: &Program) -> Block {
    let text = page::width(&label(drawing.shape, program));
    // Halves of even widths are whole.
    let even = |width: f64| (width / 2.0).ceil() * 2.0;
    let (width, height) = match drawing.shape {
        Shape::Composite(..) => (SQUARE, SQUARE),
        Shape::Parallel(_) => (SQUARE + even(text), SQUARE),
        // A text of a third of the height fits where the rhombus is two thirds as wide as it is in its middle.
        Shape::Decorator(_) => (even(text * 1.5 + 10.0), 40.0),
        Shape::Behavior(_) => (even(text + 22.0), LEAF),
        Shape::Literal(..) | Shape::Const(_) => (even(text + 28.0), LEAF),
    };
    Block {
        width,
        height,
        children: drawing
            .children
            .iter()
            .map(|child| block(child, program))
            .collect(),
    }
}

/// What is written in a box.
fn label(shape: Shape, program: &Program) -> String {
    match shape {
        Shape::Composite(_, memory) => if memory { "*" } else { "" }.to_owned(),
        Shape::Parallel(successes) => successes.to_string(),
        Shape::Decorator(kind) => kind.to_string(),
        Shape::Behavior(id) => program.behaviors[id].name.to_string(),
        Shape::Literal(atom, true) => program.atom_name(atom).to_string(),
        Shape::Literal(atom, false) => format!("not {}", program.atom_name(atom)),
        Shape::Const(value) => value.to_string(),
    }
}

/// What a node is, in words.
fn kind(shape: Shape) -> &'static str {
    match shape {
        Shape::Composite(kind, memory) => kind.word(memory),
        Shape::Parallel(_) => "parallel",
        Shape::Decorator(_) => "decorator",
        Shape::Behavior(_) => "behavior",
        Shape::Literal(..) | Shape::Const(_) => "condition",
    }
}

/// From the foot of a box down, along between the layers, and down to the head of the other.
fn edge(parent: &Placed, child: &Placed) -> String {
    let (foot, head) = (parent.y + parent.height / 2.0, child.y - child.height / 2.0);
    let [x0, x1, y0, along, y1] = [parent.x, child.x, foot, parent.below, head];
    let aside = x1 - x0;
    let bend = (aside.abs() / 2.0).min(6.0);
    if bend == 0.0 {
        return format!("M{} {}V{}", number(x0), number(y0), number(y1));
    }
    let turn = bend.copysign(aside);
    let n = number;
    format!(
        "M{} {}V{}Q{} {} {} {}H{}Q{} {} {} {}V{}",
        n(x0),
        n(y0),
        n(along - bend),
        n(x0),
        n(along),
        n(x0 + turn),
        n(along),
        n(x1 - turn),
        n(x1),
        n(along),
        n(x1),
        n(along + bend),
        n(y1)
    )
}

/// Draws a node.
fn draw(shape: Shape, place: &Placed, program: &Program, page: &mut Page) {
    let Placed { x, y, .. } = *place;
    let label = label(shape, program);
    page.open("g", &[]);
    let title = match shape {
        Shape::Composite(..) => kind(shape).to_owned(),
        _ => format!("{} {label}", kind(shape)),
    };
    page.note("title", &title);
    match shape {
        Shape::Composite(composite, memory) => {
            boxed("control", 4.0, place, page);
            let x = if memory { x - 4.0 } else { x };
            match composite {
                Composite::Sequence => page.path("symbol", arrow(x, y, 7.0)),
                Composite::Selector => page.text("name middle sign", x, y + 6.0, "?"),
            }
            if memory {
                page.path("symbol", star(x + 10.5, y - 5.0));
            }
        }
        Shape::Parallel(_) => {
            boxed("control", 4.0, place, page);
            let arrows = x - page::width(&label) / 2.0 - 2.0;
            page.path("symbol", arrow(arrows, y - 4.0, 7.0));
            page.path("symbol", arrow(arrows, y + 4.0, 7.0));
            page.text("name", arrows + 12.0, y + 4.0, &label);
        }
        Shape::Decorator(_) => {
            let (right, down) = (place.width / 2.0, place.height / 2.0);
            let corners = [[x - right, y], [x, y - down], [x + right, y], [x, y + down]];
            page.path("decorator", page::chain(corners) + "Z");
            page.text("name middle", x, y + 4.0, &label);
        }
        Shape::Behavior(_) => {
            boxed("behavior", 4.0, place, page);
            page.text("name middle", x, y + 4.0, &label);
        }
        Shape::Literal(..) | Shape::Const(_) => {
            boxed("condition", place.height / 2.0, place, page);
            page.text("name middle", x, y + 4.0, &label);
        }
    }
    page.close();
}

/// A box with round corners.
fn boxed(class: &str, round: f64, place: &Placed, page: &mut Page) {
    let attributes = [
        ("class", class.into()),
        ("x", (place.x - place.width / 2.0).into()),
        ("y", (place.y - place.height / 2.0).into()),
        ("width", place.width.into()),
        ("height", place.height.into()),
        ("rx", round.into()),
    ];
    page.leaf("rect", &attributes);
}

/// → as a path, for fonts draw it in many ways.
fn arrow(x: f64, y: f64, half: f64) -> String {
    let tip = x + half;
    let shaft = page::chain([[x - half, y], [tip, y]]);
    shaft + &page::chain([[tip - 4.0, y - 4.0], [tip, y], [tip - 4.0, y + 4.0]])
}

/// A star of six rays.
fn star(x: f64, y: f64) -> String {
    let rays = [[0.0, 3.5], [3.0, 1.75], [3.0, -1.75]];
    rays.map(|[dx, dy]| page::chain([[x - dx, y - dy], [x + dx, y + dy]]))
        .concat()
}
