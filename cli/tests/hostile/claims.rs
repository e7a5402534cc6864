//! Claims and papers, in every format of `check`.

use super::declarations::outside_of_comments;
use super::seen::{is_seen, run};
use super::{MOUNT, toml};
use crate::support::Folder;
use testkit::hostile;

/// A claims file in which every string is the name of a claim that has a verdict.
fn named() -> String {
    let claim = |text: &String| {
        format!(
            "[[claim]]\nname = {}\nobservable = \"sight\"\ncomponents = ['0', '0', '-tilt']\n",
            toml(text)
        )
    };
    hostile().iter().map(claim).fold("chain = \"m.chain\"\n".to_owned(), |all, one| all + &one)
}

#[test]
fn names_of_claims() {
    let folder = Folder::new("hostile-claims");
    folder.write("m.chain", MOUNT).write("c.toml", named());
    for format in ["text", "json", "markdown", "latex", "html"] {
        let said = run(&folder, &["check", "c.toml", "--format", format]);
        assert!(said.code < 2, "{format}: {}", said.stderr);
        let text = &said.stdout;
        match format {
            "text" => assert_eq!(
                text.lines().filter(|line| line.starts_with("holds") || line.starts_with("differs")).count(),
                hostile().len(),
                "{text}"
            ),
            "json" => {
                let read: serde_json::Value = serde_json::from_str(text).expect("JSON");
                let names = read["claims"]
                    .as_array()
                    .expect("a list")
                    .iter()
                    .map(|claim| claim["name"].as_str().expect("a name").to_owned());
                assert_eq!(names.collect::<Vec<_>>(), hostile(), "names come through as they are");
            }
            "markdown" => {
                let rows = text.lines().filter(|line| line.starts_with('|')).count();
                assert_eq!(rows, hostile().len() + 2, "{text}");
                assert!(
                    !text.contains("<injected") && !text.contains("<script") && !text.contains("```"),
                    "{text}"
                );
            }
            "latex" => {
                let body = text.lines().filter(|line| !line.starts_with('%')).collect::<Vec<_>>().join("\n");
                assert!(
                    !body.contains("\\input")
                        && !body.contains("\\immediate")
                        && !body.contains("\\injected"),
                    "{text}"
                );
                assert_eq!(text.matches("\\end{").count(), 1, "{text}");
            }
            _ => {
                assert_eq!(text.matches("<tr>").count(), hostile().len() + 1, "{text}");
                assert!(!text.contains("<injected") && !text.contains("<script"), "{text}");
            }
        }
    }
    let said = run(&folder, &["check", "c.toml", "--certificate", "c.v"]);
    assert!(said.code < 2, "{}", said.stderr);
    is_seen(&folder.read("c.v"), "c.v");
    assert!(!outside_of_comments(&folder.read("c.v")).contains("injected()"));
    let said = run(&folder, &["budget", "m.chain", "--sizes", "e.toml", "--claims", "c.toml"]);
    assert_eq!(said.code, 2, "there are no sizes");
}

#[test]
fn mistaken_claims() {
    let folder = Folder::new("hostile-mistaken");
    folder.write("m.chain", MOUNT);
    let formulas: String = hostile()
        .iter()
        .map(|text| {
            let text = toml(text);
            format!(
                "[[claim]]\nname = {text}\nobservable = \"sight\"\ncomponents = [{text}, '0', '0']\n\
                 [[claim]]\nname = \"x\"\nobservable = {text}\ncomponents = ['0', '0', '0']\n\
                 [[claim]]\nname = \"y\"\ncount = {{ errors = {text}, equals = 1 }}\n\
                 [[claim]]\nname = \"z\"\n{text} = 1\n"
            )
        })
        .collect();
    folder.write("c.toml", format!("chain = \"m.chain\"\n{formulas}"));
    for format in ["text", "json", "markdown", "latex", "html"] {
        let said = run(&folder, &["check", "c.toml", "--format", format]);
        assert_eq!(said.code, 2, "{format}: {}", said.stderr);
        let is_markup = ["markdown", "html"].contains(&format);
        assert!(
            !is_markup || !said.stdout.contains("<injected") && !said.stdout.contains("<script"),
            "{}",
            said.stdout
        );
        if format == "json" && !said.stdout.is_empty() {
            assert!(serde_json::from_str::<serde_json::Value>(&said.stdout).is_ok(), "{}", said.stdout);
        }
    }
}

#[test]
fn papers() {
    let folder = Folder::new("hostile-papers");
    folder.write("m.chain", MOUNT);
    let equations: String = hostile()
        .iter()
        .map(|text| {
            let text = text.replace(['\n', '\r'], " ");
            format!("{text}\n\n\\begin{{equation}}\n  x = {text} + \\epsilon\n\\end{{equation}}\n\n$$ y = {text} $$\n\n")
        })
        .collect();
    folder.write("p.tex", &equations).write("p.md", &equations);
    for paper in ["p.tex", "p.md"] {
        for format in ["text", "json", "markdown", "latex", "html"] {
            let claims = format!("{paper}.toml");
            let arguments =
                ["check", paper, "--chain", "m.chain", "--claims-file", &claims, "--format", format];
            let said = run(&folder, &arguments);
            let is_markup = ["markdown", "html"].contains(&format);
            assert!(
                !is_markup || !said.stdout.contains("<injected") && !said.stdout.contains("<script"),
                "{}",
                said.stdout
            );
            let _ = std::fs::remove_file(folder.0.join(&claims));
        }
    }
}
