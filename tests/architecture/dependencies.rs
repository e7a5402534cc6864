//! Who may depend on whom.

use std::collections::BTreeMap;
use std::process::Command;

use serde_json::Value;

use crate::sources::root;

/// Each package of the workspace with the packages of the workspace that it may use, dev-dependencies aside.
const MAY_USE: &[(&str, &[&str])] = &[
    // What it makes shares no code with what it tests.
    ("trueaxis-testkit", &[]),
    ("trueaxis-core", &[]),
    ("trueaxis-claims", &["trueaxis-core"]),
    ("trueaxis-proof", &["trueaxis-core", "trueaxis-claims"]),
    ("trueaxis-codegen", &["trueaxis-core"]),
    ("trueaxis-macros", &["trueaxis-core", "trueaxis-codegen"]),
    ("trueaxis-evidence", &[]),
    ("trueaxis-parallel", &[]),
    ("trueaxis-tables", &["trueaxis-core", "trueaxis-parallel"]),
    ("trueaxis-observe", &["trueaxis-core", "trueaxis-codegen", "trueaxis-parallel", "trueaxis-tables"]),
    ("trueaxis-effects", &["trueaxis-core", "trueaxis-codegen"]),
    (
        "trueaxis-fit",
        &["trueaxis-core", "trueaxis-codegen", "trueaxis-parallel", "trueaxis-tables", "trueaxis-observe"],
    ),
    (
        "trueaxis-network",
        &[
            "trueaxis-core",
            "trueaxis-codegen",
            "trueaxis-parallel",
            "trueaxis-tables",
            "trueaxis-observe",
            "trueaxis-fit",
        ],
    ),
    (
        "trueaxis-study",
        &[
            "trueaxis-core",
            "trueaxis-codegen",
            "trueaxis-parallel",
            "trueaxis-tables",
            "trueaxis-observe",
            "trueaxis-effects",
            "trueaxis-fit",
            "trueaxis-network",
        ],
    ),
    (
        "trueaxis-calibration",
        &[
            "trueaxis-core",
            "trueaxis-codegen",
            "trueaxis-parallel",
            "trueaxis-tables",
            "trueaxis-observe",
            "trueaxis-effects",
            "trueaxis-fit",
            "trueaxis-network",
            "trueaxis-study",
            "trueaxis-evidence",
        ],
    ),
    (
        "trueaxis-class",
        &["trueaxis-core", "trueaxis-codegen", "trueaxis-tables", "trueaxis-observe", "trueaxis-fit"],
    ),
    (
        "trueaxis-report",
        &[
            "trueaxis-core",
            "trueaxis-codegen",
            "trueaxis-parallel",
            "trueaxis-tables",
            "trueaxis-observe",
            "trueaxis-effects",
            "trueaxis-fit",
            "trueaxis-network",
            "trueaxis-study",
            "trueaxis-calibration",
        ],
    ),
    (
        "trueaxis-init",
        &[
            "trueaxis-core",
            "trueaxis-codegen",
            "trueaxis-parallel",
            "trueaxis-tables",
            "trueaxis-observe",
            "trueaxis-effects",
            "trueaxis-fit",
            "trueaxis-network",
            "trueaxis-study",
        ],
    ),
    (
        "trueaxis-service",
        &[
            "trueaxis-core",
            "trueaxis-claims",
            "trueaxis-codegen",
            "trueaxis-parallel",
            "trueaxis-tables",
            "trueaxis-observe",
            "trueaxis-effects",
            "trueaxis-fit",
            "trueaxis-network",
            "trueaxis-study",
            "trueaxis-calibration",
            "trueaxis-report",
            "trueaxis-init",
        ],
    ),
    (
        "trueaxis-web",
        &[
            "trueaxis-core",
            "trueaxis-claims",
            "trueaxis-codegen",
            "trueaxis-tables",
            "trueaxis-report",
            "trueaxis-service",
            "trueaxis-init",
        ],
    ),
    (
        "trueaxis",
        &[
            "trueaxis-core",
            "trueaxis-claims",
            "trueaxis-proof",
            "trueaxis-macros",
            "trueaxis-codegen",
            "trueaxis-calibration",
            "trueaxis-study",
        ],
    ),
    (
        "trueaxis-cli",
        &[
            "trueaxis-core",
            "trueaxis-claims",
            "trueaxis-proof",
            "trueaxis-codegen",
            "trueaxis-parallel",
            "trueaxis-tables",
            "trueaxis-observe",
            "trueaxis-effects",
            "trueaxis-fit",
            "trueaxis-network",
            "trueaxis-study",
            "trueaxis-calibration",
            "trueaxis-class",
            "trueaxis-report",
            "trueaxis-service",
            "trueaxis-init",
        ],
    ),
];

fn packages() -> Vec<Value> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version=1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo metadata is JSON");
    metadata["packages"].as_array().expect("a list of packages").clone()
}

#[test]
fn packages_depend_only_on_what_the_architecture_allows() {
    let packages = packages();
    let ours: Vec<&str> = packages.iter().filter_map(|package| package["name"].as_str()).collect();
    let table: BTreeMap<&str, &[&str]> = MAY_USE.iter().copied().collect();
    for name in table.keys() {
        assert!(ours.contains(name), "{name} stands in the table but not in the workspace");
    }
    for package in &packages {
        let name = package["name"].as_str().expect("a package has a name");
        let Some(allowed) = table.get(name) else { continue };
        for dependency in package["dependencies"].as_array().expect("a list of dependencies") {
            let used = dependency["name"].as_str().expect("a dependency has a name");
            let in_build = dependency["kind"] != "dev";
            if in_build && ours.contains(&used) {
                assert!(
                    allowed.contains(&used),
                    "{name} depends on {used}; ARCHITECTURE.md does not allow it"
                );
            }
        }
    }
}

#[test]
fn nothing_depends_on_the_command_or_the_benchmarks() {
    for package in packages() {
        for dependency in package["dependencies"].as_array().expect("a list of dependencies") {
            let used = dependency["name"].as_str().expect("a dependency has a name");
            assert!(
                !["trueaxis-cli", "trueaxis-benches"].contains(&used),
                "{} depends on {used}",
                package["name"]
            );
        }
    }
}
