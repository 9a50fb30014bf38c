//! Snapshots lie in one folder, named for what they show.

/// How all of them are kept.
pub(crate) fn settings() -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.remove_input_file();
    settings
}

/// Compares with the snapshot of this name.
pub(crate) fn check(name: &str, text: &str) {
    settings().bind(|| insta::assert_snapshot!(name, text));
}
