//! Every example, as each stage sees it: one snapshot a form.

use crate::snapshot;
use btc::driver::compile;
use btc::driver::compile::Form;
use btc::driver::load::{Loaded, Reader, load};
use btc::emit::form::TreeForm;
use std::fs;
use std::path::Path;

/// Files as the examples have them.
pub(crate) struct Disk;

impl Reader for Disk {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        fs::read(path).map_err(|error| error.to_string())
    }
}

/// An example by its name without ending, loaded and free of mistakes.
pub(crate) fn example(name: &str) -> Loaded {
    let path = format!("{}/examples/{name}.bt", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read(&path).unwrap();
    let loaded = load(&format!("{name}.bt"), text, &mut Disk);
    assert!(loaded.diagnostics.is_empty(), "{:?}", loaded.diagnostics);
    loaded
}

pub(crate) fn names() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "bt"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn in_every_form() {
    for name in names() {
        let loaded = example(&name);
        snapshot::check(&format!("{name}.summary"), &compile::summary(&loaded));
        for (form, ending) in [
            (Form::Ast, "ast"),
            (Form::Ir, "ir"),
            (Form::Tree(TreeForm::Json), "json"),
        ] {
            let text = compile::emit(&loaded, form, None).unwrap();
            snapshot::check(&format!("{name}.{ending}"), &text);
        }
        for tree in loaded.program.trees.values() {
            for (form, ending) in [
                (Form::Tree(TreeForm::Bt), "bt"),
                (Form::Tree(TreeForm::Dot), "dot"),
            ] {
                let text = compile::emit(&loaded, form, Some(&tree.name.to_string())).unwrap();
                snapshot::check(&format!("{name}.{}.{ending}", tree.name), &text);
            }
        }
    }
}

#[test]
fn printed_trees_mean_what_they_meant() {
    for name in names() {
        let loaded = example(&name);
        let path = format!("{}/examples/{name}.bt", env!("CARGO_MANIFEST_DIR"));
        let source = fs::read_to_string(path).unwrap();
        for tree in loaded.program.trees.values() {
            let printed = compile::emit(
                &loaded,
                Form::Tree(TreeForm::Bt),
                Some(&tree.name.to_string()),
            )
            .unwrap();
            let renamed = printed.replace(
                &format!("tree {} ", tree.name),
                &format!("tree {}_again ", tree.name),
            );
            let again = load(
                "again.bt",
                format!("{source}\n{renamed}").into_bytes(),
                &mut Disk,
            );
            assert!(again.diagnostics.is_empty(), "{printed}");
            let known = again.program.trees.values().last().unwrap();
            assert_eq!(known.root, tree.root, "{printed}");
        }
    }
}
