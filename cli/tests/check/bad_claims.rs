//! Claims files with mistakes: each is named with its place, and the exit code is 2.

use super::support::Folder;

/// What `check` says of a claims file about the mobile lidar.
fn refused(name: &str, claims: &str) -> String {
    let folder = Folder::new(&format!("check_{name}"));
    folder.copy("examples/mobile-lidar/mobile-lidar.chain").write("claims.toml", claims);
    let run = folder.trueaxis(&["check", "claims.toml"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{}", run.stderr);
    run.stderr
}

#[test]
fn every_mistake_of_a_file_is_named_with_its_place() {
    let said = refused(
        "mistakes",
        r#"chain = "mobile-lidar.chain"
[symbols]
'\Delta\theta_{y9}' = "dtheta_y9"
'\frac' = "dtheta_y1"
'q' = "2*"
[[claim]]
name = "an unknown symbol in LaTeX"
observable = "pointing"
components = ['\Delta\theta_{x3}^2 \cos\bta', "dtheta_y1*cos(bet)", '(\cos\beta']
[[claim]]
name = "two components"
observable = "pointing"
components = ['0', '0']
[[claim]]
name = "a fourth component"
observable = "pointing"
components = ['0', '0', '0', '1']
[[claim]]
name = "keep and neglect"
observable = "pointing"
keep = ["dtheta_*"]
neglect = ["dx1"]
components = ['0', '0', '0']
[[claim]]
name = "patterns that match nothing"
observable = "pointing"
keep = ["theta_*", "dtheta_y"]
components = ['0', '0', '0']
[[claim]]
name = "no such observable"
observable = "ponting"
components = ['0', '0', '0']
[[claim]]
name = "the sine of an error"
observable = "pointing"
components = ['\sin \Delta\theta_{x3}^2', '0', '0']
[[claim]]
name = "two kinds"
components = ['0', '0', '0']
count = { errors = "*", equals = 30 }
[[claim]]
name = "no kind"
[[claim]]
name = "order of a count"
order = 2
count = { errors = "*", equals = -1 }
[[claim]]
name = "order four"
observable = "pointing"
order = 4
components = ['0', '0', '0']
[[claim]]
name = "sizes and paths"
compare = { error = "dg2", against = "dx1", size = "10 arcsec", measure = "rms", at_most = 0.1 }
path = "alpha=t, bta=t, gamma=t"
[[claim]]
name = "units and measures"
compare = { error = "dg2", against = "db2", size = "10 mm", measure = "mean", at_most = 0.1 }
path = "alpha=t, beta=t + , gamma=t"
[[claim]]
name = "ranges"
compare = { error = "d*2", against = "db2", size = 1e-5, measure = "sup", at_most = 0.1 }
range = ["beta=90 deg..10 deg"]
"#,
    );
    insta::assert_snapshot!(said);
}

#[test]
fn what_a_comparison_leaves_open_is_said_at_its_name() {
    let said = refused(
        "open_path",
        r#"chain = "mobile-lidar.chain"
[[claim]]
name = "no gamma"
compare = { error = "dg2", against = "db2", size = "10 arcsec", measure = "rms", at_most = 0.1 }
path = "alpha=t, beta=t"
"#,
    );
    insta::assert_snapshot!(said);
}

#[test]
fn the_file_itself_is_minded() {
    for (name, text, wanted) in [
        (
            "unknown_key",
            "chain = \"mobile-lidar.chain\"\ncolour = 1\n[[claim]]\nname = \"a\"\n",
            "claims.toml:2:1",
        ),
        (
            "unknown_claim_key",
            "chain = \"mobile-lidar.chain\"\n[[claim]]\nname = \"a\"\nerors = \"*\"\n",
            "claims.toml:4:1",
        ),
        ("no_chain", "chain = \"mobile-lidr.chain\"\n", "did you mean `mobile-lidar.chain`"),
        ("no_claim", "chain = \"mobile-lidar.chain\"\n", "this file makes no claim"),
        ("not_toml", "chain = mobile\n", "claims.toml:1:9"),
        ("wrong_type", "chain = \"mobile-lidar.chain\"\n[[claim]]\nname = 3\n", "claims.toml:3:8"),
        ("chain_missing", "[[claim]]\nname = \"a\"\n", "chain"),
    ] {
        let said = refused(name, text);
        assert!(said.contains(wanted), "{name}: {said}");
    }
}
