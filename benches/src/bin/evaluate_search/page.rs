//! The page of the book: the table, and how it was made.

use std::fmt::Write as _;
use std::time::Duration;

use crate::design::{Design, Failure, Poses};
use crate::rate::Line;

/// A line of the table.
pub fn row(line: &Line) -> String {
    format!(
        "| {} | {} | {} | {} | {} | {} | {} | {:.1} s |",
        // A bar would begin another cell.
        line.what.replace('|', "\\|"),
        line.target,
        line.shown,
        line.met(),
        line.through,
        line.runs,
        line.seed,
        line.took.as_secs_f64()
    )
}

/// The whole page.
pub fn page(lines: &[Line], took: Duration) -> Result<String, Failure> {
    let design = Design::new(1000, Poses::Random(1.0), 1)?;
    let (candidates, sets) = (design.problem.candidates().len(), design.sets.len());
    let declared = design.problem.declared();
    let met = lines.iter().filter(|line| line.met() == "yes").count();
    let judged = lines.iter().filter(|line| !line.met().is_empty()).count();
    let mut page = format!(
        "\
# How often the search is right

<!-- Written by `cargo run --release -p trueaxis-benches --bin evaluate_search -- --page docs/src/diagnosis/evaluation.md` -->

Many instruments are simulated, each with another noise and another effect, and the search reports what it finds. The
instrument is the scanner of a mobile lidar (`examples/mobile-lidar`), seen by its directions: {candidates} candidate
effects in {sets} sets beside the {declared} combinations of declared errors that its directions show. The
false-alarm rate asked for is 5 %, with 999 sign flips and ten folds, as in a study without other settings.

- *linear*: the whitened linear problem alone. The columns stay, the residual is drawn anew: independent normal noise of
  unknown size, and a planted effect in a random direction of its coefficients. Each planted candidate is drawn evenly
  from the catalogue; SNR is the RMS of the projected effect a component over σ.
- *whole*: everything that `calibrate` does. Readings and declared errors (10 σ each) go through the exact chain, noise is
  added on the sky, and the calibration knows nothing of it: fit, noise model, search, refits, what remains.

Right means that the first effect in the report is of the set that was planted. Behind ± is half the 95 % interval
of the binomial rate. Run i of a case draws from the seed in the table plus i; poses are drawn from that seed itself.
{met} of {judged} figures are met; all cases together took {:.0} s on two shared cores.

One such instrument is in the examples, with an encoder off centre. The search finds it, and the error on held-out data falls to the noise:

```sh
trueaxis calibrate examples/mobile-lidar/study.toml --out result
```

![Error on held-out data: as delivered, calibrated, and with the effect](evaluation.svg)

| what | target | measured | met | through | runs | seed | took |
|---|---|---|---|---|---|---|---|
",
        took.as_secs_f64()
    );
    for line in lines {
        let _ = writeln!(page, "{}", row(line));
    }
    Ok(page)
}
