//! Whatever the text, the checker does not panic, every message lies in its file, and a program without errors is whole.

use btc::diagnostic::render;
use btc::driver::compile::{self, Form};
use btc::driver::load::{Loaded, Reader, load};
use btc::emit::form::TreeForm;
use btc::syntax::ast::{ItemKind, Trigger};

/// The law.
pub fn holds(bytes: &[u8]) {
    whole(bytes.to_vec());
}

/// What has to hold of a text.
pub(crate) fn whole(bytes: Vec<u8>) -> Loaded {
    let loaded = told(bytes);
    if !loaded.has_errors() {
        complete(&loaded);
        compile::summary(&loaded);
        for form in [
            Form::Ast,
            Form::Ir,
            Form::Tree(TreeForm::Bt),
            Form::Tree(TreeForm::Dot),
            Form::Tree(TreeForm::Json),
        ] {
            // Of several trees it has to be said which one is drawn.
            let _ = compile::emit(&loaded, form, None);
            for tree in loaded.program.trees.values() {
                compile::emit(&loaded, form, Some(&tree.name.to_string())).unwrap();
            }
        }
    }
    loaded
}

/// What has to hold of a text, as far as a person is told.
pub(crate) fn told(bytes: Vec<u8>) -> Loaded {
    let loaded = load("mutant.bt", bytes, &mut NoFiles);
    for found in &loaded.diagnostics {
        let edits = found.fixes.iter().flat_map(|fix| &fix.edits);
        let spans = found.labels.iter().map(|label| label.span);
        for span in spans.chain(edits.map(|(span, _)| *span)) {
            let source = loaded.sources.get(span.file).unwrap();
            assert!(span.start <= span.end, "{found:?}");
            assert!(source.text.get(span.range()).is_some(), "{found:?}");
        }
    }
    shown(&loaded);
    loaded
}

/// Nothing of a program without errors is left out.
fn complete(loaded: &Loaded) {
    let count = |wanted: fn(&ItemKind) -> bool| {
        let items = loaded.ast.items.iter();
        items.filter(|item| wanted(&item.kind)).count()
    };
    let program = &loaded.program;
    let trees = count(|item| matches!(item, ItemKind::Tree(tree) if tree.params.is_none()));
    // What another robot runs belongs to that robot.
    let others = program.world.as_ref().map_or(0, |world| world.others.len());
    assert!(program.trees.len() <= trees && trees <= program.trees.len() + others);
    let tasks = count(|item| matches!(item, ItemKind::Task(_)));
    assert_eq!(program.tasks.len(), tasks);
    let learners = count(|item| matches!(item, ItemKind::Learn(_)));
    assert_eq!(program.learners.len(), learners);
    let claims = count(|item| matches!(item, ItemKind::Claim(_)));
    assert_eq!(program.claims.len(), claims);
    // A family has as many as its kind has members.
    let events = count(|item| matches!(item, ItemKind::Event(event) if event.params.is_none()));
    let families = count(|item| matches!(item, ItemKind::Event(event) if event.params.is_some()));
    assert!(program.events.len() >= events && (families > 0 || program.events.len() == events));
    let effects = count(|item| is_on(item, |trigger| matches!(trigger, Trigger::Expr(_))));
    let families = count(|item| is_on(item, |trigger| !matches!(trigger, Trigger::Expr(_))));
    assert!(program.effects.len() >= effects && (families > 0 || program.effects.len() == effects));
    let states = count(|item| matches!(item, ItemKind::State(state) if state.params.is_none()));
    assert!(program.states.len() >= states);
}

fn is_on(item: &ItemKind, by: fn(&Trigger) -> bool) -> bool {
    matches!(item, ItemKind::On(on) if by(&on.trigger))
}

/// No file but the one that is asked for.
pub(crate) struct NoFiles;

impl Reader for NoFiles {
    fn read(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Err("there are no files here".to_owned())
    }
}

/// What a person is shown of a program.
pub(crate) fn shown(loaded: &Loaded) -> String {
    render::human(&loaded.sources, &loaded.diagnostics, false)
}
