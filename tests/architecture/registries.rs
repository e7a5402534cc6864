//! Registries: a plural folder with one file an entry (and helpers that entries share), and one table in its `mod.rs`.

use crate::sources::below;

/// The registries of the project.
const REGISTRIES: &[&str] = &[
    "cli/src/commands",
    "codegen/src/backends",
    "effects/src/families",
    "init/src/templates",
    "observe/src/kinds",
    "tables/src/formats",
    "calibration/src/misread/hypotheses",
    "evidence/src/families",
    "class/src/instruments",
    "service/src/export/forms",
    "fuzz/src/targets",
];

#[test]
fn no_file_of_a_registry_is_forgotten_by_its_table() {
    for registry in REGISTRIES {
        let files = below(registry);
        let table_path = format!("{registry}/mod.rs");
        let table = files.iter().find(|file| file.path == table_path).expect("a registry has a table");
        for file in &files {
            let entry = file.path.trim_start_matches(registry).trim_start_matches('/');
            let name = entry.split(['/', '.']).next().unwrap_or_default();
            if name != "mod" {
                assert!(
                    table.text.contains(&format!("mod {name};")),
                    "{registry}: `{name}` is not in the table"
                );
            }
        }
    }
}
