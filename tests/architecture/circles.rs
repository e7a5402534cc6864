//! No circles: of two rooms beside each other, or two files of one room, at most one needs the other.

use std::collections::{BTreeMap, BTreeSet};

use crate::sources::{LIBRARIES, SourceFile, below};

/// A module's way from the root of its package: `["fit", "noise"]`.
type Way = Vec<String>;

/// Who needs whom among the modules of one folder, and in which file that stands.
type Needs = BTreeMap<String, BTreeMap<String, String>>;

#[test]
fn no_two_modules_beside_each_other_need_each_other() {
    for package in
        LIBRARIES.iter().copied().chain(["cli/src", "benches/src", "fuzz/src", "testkit/src", "python/src"])
    {
        for (folder, needs) in folders(package) {
            if let Some(circle) = circle(&needs) {
                let steps: Vec<String> = circle
                    .windows(2)
                    .map(|step| format!("{} needs {} ({})", step[0], step[1], needs[&step[0]][&step[1]]))
                    .collect();
                panic!("a circle in {package}/{folder}: {}", steps.join(", "));
            }
        }
    }
}

/// What the modules of each folder of a package need of each other.
fn folders(package: &str) -> BTreeMap<String, Needs> {
    let files: Vec<(Way, SourceFile)> = below(package)
        .into_iter()
        .map(|file| (way(package, &file.path), file))
        .filter(|(way, _)| way.last().is_none_or(|name| name != "tests"))
        .collect();
    let modules: BTreeSet<Way> =
        files.iter().flat_map(|(way, _)| (1..=way.len()).map(|length| way[..length].to_vec())).collect();
    let mut folders: BTreeMap<String, Needs> = BTreeMap::new();
    for (own, file) in &files {
        let code: Vec<&str> = file.code().map(|(_, line)| line).collect();
        for needed in paths(&code.join("\n"), own) {
            let shared = own.iter().zip(&needed).take_while(|(a, b)| a == b).count();
            if let (Some(from), Some(to)) = (own.get(shared), needed.get(shared))
                && modules.contains(&needed[..=shared])
            {
                let needs = folders.entry(own[..shared].join("/")).or_default();
                needs.entry(from.clone()).or_default().entry(to.clone()).or_insert_with(|| file.path.clone());
            }
        }
    }
    folders
}

/// `model-core/src/forms/mod.rs` is the module `forms`.
fn way(package: &str, path: &str) -> Way {
    let inside =
        path.strip_prefix(package).and_then(|path| path.strip_prefix('/')).expect("a file of the package");
    let mut way: Way = inside.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if way.last().is_some_and(|name| ["mod", "lib", "main"].contains(&name.as_str())) {
        way.pop();
    }
    way
}

/// Every path of the package that a module names, from the package's root.
fn paths(code: &str, own: &[String]) -> Vec<Way> {
    let mut found = Vec::new();
    for root in ["crate::", "super::"] {
        for (at, _) in code.match_indices(root) {
            let before = code[..at].chars().next_back().unwrap_or(' ');
            if before == ':' || before == '_' || before.is_alphanumeric() {
                continue;
            }
            let mut base = own.to_vec();
            let mut rest = &code[at..];
            if let Some(behind) = rest.strip_prefix("crate::") {
                base.clear();
                rest = behind;
            }
            while let Some(behind) = rest.strip_prefix("super::") {
                base.pop();
                rest = behind;
            }
            branches(&base, rest, &mut found);
        }
    }
    found
}

/// The paths `a::{b, c::d}` from a base.
fn branches(base: &[String], text: &str, found: &mut Vec<Way>) {
    let text = text.trim_start();
    if let Some(inside) = text.strip_prefix('{') {
        let (mut depth, mut start) = (0_usize, 0);
        for (at, letter) in inside.char_indices() {
            match letter {
                '{' => depth += 1,
                '}' if depth > 0 => depth -= 1,
                ',' | '}' if depth == 0 => {
                    branches(base, &inside[start..at], found);
                    start = at + 1;
                    if letter == '}' {
                        return;
                    }
                }
                _ => {}
            }
        }
        return;
    }
    let end = text.find(|c: char| c != '_' && !c.is_alphanumeric()).unwrap_or(text.len());
    if end == 0 {
        return;
    }
    let mut path = base.to_vec();
    path.push(text[..end].to_owned());
    match text[end..].strip_prefix("::") {
        Some(rest) => branches(&path, rest, found),
        None => found.push(path),
    }
}

/// Modules that need each other in a circle, the first again at the end.
fn circle(needs: &Needs) -> Option<Vec<String>> {
    let mut done = BTreeSet::new();
    needs.keys().find_map(|name| walk(name, needs, &mut Vec::new(), &mut done))
}

fn walk(
    name: &str,
    needs: &Needs,
    trail: &mut Vec<String>,
    done: &mut BTreeSet<String>,
) -> Option<Vec<String>> {
    if let Some(at) = trail.iter().position(|passed| passed == name) {
        let mut circle = trail[at..].to_vec();
        circle.push(name.to_owned());
        return Some(circle);
    }
    if done.contains(name) {
        return None;
    }
    trail.push(name.to_owned());
    let found =
        needs.get(name).into_iter().flat_map(BTreeMap::keys).find_map(|next| walk(next, needs, trail, done));
    trail.pop();
    done.insert(name.to_owned());
    found
}

#[test]
fn a_circle_is_seen() {
    let own = ["fit".to_owned(), "solve".to_owned()];
    let code = "use super::{descent::Course, size};\nuse crate::data::{self, units::{Unit}};\nfn f() { super::super::x::y() }";
    let joined: BTreeSet<String> = paths(code, &own).iter().map(|path| path.join("/")).collect();
    let expected = ["data/self", "data/units/Unit", "fit/descent/Course", "fit/size", "x/y"];
    assert_eq!(joined, expected.map(str::to_owned).into());

    let needs = |pairs: &[(&str, &str)]| {
        let mut needs = Needs::new();
        for (from, to) in pairs {
            needs.entry((*from).to_owned()).or_default().insert((*to).to_owned(), String::new());
        }
        needs
    };
    assert_eq!(circle(&needs(&[("a", "b"), ("b", "c"), ("a", "c")])), None);
    let round = circle(&needs(&[("a", "b"), ("b", "c"), ("c", "b")]));
    assert_eq!(round, Some(["b", "c", "b"].map(str::to_owned).to_vec()));
}
