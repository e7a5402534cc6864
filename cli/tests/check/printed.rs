//! What `derive` prints is what `check` reads: every observable of every example, component by component and as a whole.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{Folder, root, trueaxis};

/// Whose form to second order takes half a minute or more than a file of claims may hold (16 MiB): to first order alone.
const LONG: [&str; 2] = ["examples/total-station/telescope.chain", "examples/ur10/ur10.chain"];

/// The declarations below a folder, in order.
fn declarations(folder: &Path, found: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).expect("a folder of the workspace");
    let mut entries: Vec<PathBuf> = entries.map(|entry| entry.expect("readable").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            declarations(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "chain") {
            found.push(path);
        }
    }
}

/// A claim of the closed form of an observable, as printed.
fn claim(claims: &mut String, name: &str, observable: &str, order: u32, components: &str) {
    let head = format!("[[claim]]\nname = '{name}'\nobservable = '{observable}'\norder = {order}");
    writeln!(claims, "{head}\ncomponents = {components}\n").expect("a text");
}

#[test]
fn what_is_printed_is_read() {
    let mut chains = Vec::new();
    declarations(&root().join("examples"), &mut chains);
    assert!(chains.len() >= 28, "{chains:?}");
    let folder = Folder::new("check_printed");
    let mut forms = 0;
    for chain in &chains {
        let path = chain.to_str().expect("UTF-8");
        for order in 1..=if LONG.iter().any(|long| path.ends_with(long)) { 1 } else { 2 } {
            let printed =
                |format| trueaxis(&["derive", path, "--order", &order.to_string(), "--format", format]);
            let derived = printed("json");
            let without = ["no observable of this chain has a closed form", "has no closed form yet"];
            if derived.code == 2 && without.iter().any(|said| derived.stderr.contains(said)) {
                continue;
            }
            assert_eq!(derived.code, 0, "{path}: {derived}");
            let derived: Value = serde_json::from_str(&derived.stdout).expect("JSON");
            let whole = printed("latex").stdout;
            // Each observable begins with a comment.
            let blocks: Vec<&str> = whole.split("\n%").collect();
            let observables = derived["observables"].as_array().expect("observables");
            assert_eq!(blocks.len(), observables.len(), "{path}");

            let mut claims = format!("chain = '{path}'\n\n");
            for (observable, block) in observables.iter().zip(blocks) {
                let name = observable["name"].as_str().expect("a name");
                let components = observable["components"].as_object().expect("components");
                for style in ["latex", "text"] {
                    // Of one number alone; JSON says nothing of their order.
                    for (component, shown) in components {
                        let shown = shown[style].as_str().expect("a formula");
                        claim(
                            &mut claims,
                            &format!("{name} {component} {style}"),
                            name,
                            order,
                            &format!("'''{shown}'''\ncomponent = '{component}'"),
                        );
                    }
                }
                let block = format!("%{}", block.trim_start_matches('%'));
                claim(&mut claims, &format!("{name} whole"), name, order, &format!("'''\n{block}'''"));
                forms += 1;
            }
            folder.write("claims.toml", claims);
            let checked = folder.trueaxis(&["check", "claims.toml"]);
            assert_eq!(checked.code, 0, "{path}, order {order}: {checked}");
        }
    }
    assert!(forms > 70, "{forms}");
}
