//! Answers that cannot be read, in whole or in part, and declarations that no student should hand in.

use super::{class, graded, of, perfect, true_one, words};
use crate::grade::{Handed, grade};
use crate::policy::ARCSEC_RAD;
use crate::report::feedback;
use crate::rubric::{Item, full};

#[test]
fn an_answer_that_cannot_be_read_has_its_reason() {
    let (_, key, _) = class(&["Ada"], 1);
    let student = &key.students[0];
    let long = "#".repeat(70_000);
    let broken = [
        ("", "missing field `mark`"),
        ("\0\0", "cannot be read"),
        ("mark = 3", "invalid type"),
        ("mark = \"x\"\nsize = 3 pm 1", "line 2: "),
        (long.as_str(), "more than"),
    ];
    for (answer, why) in broken {
        let marked = graded(&key, student, answer, "");
        assert_eq!(marked.points, 0.0);
        assert!(marked.not_graded.clone().unwrap().contains(why), "{answer}: {marked:?}");
    }
}

#[test]
fn what_is_wrong_in_one_item_costs_that_item_alone() {
    let (_, key, _) = class(&["Ada"], 1);
    let student = &key.students[0];
    let task = key.task(student).unwrap();
    let good = perfect(&task, &student.mark);
    let size = good.lines().find(|line| line.starts_with("size")).unwrap();
    let truth = task.numbers[0].truth_arcsec;
    let spoiled = [
        ("nan, uncertainty = 1.0".to_owned(), "above zero"),
        ("1.0, uncertainty = -1.0".to_owned(), "above zero"),
        ("1.0".to_owned(), "write it as `size = { value"),
        ("1e300, uncertainty = 1e300".to_owned(), "1.0e300″ is right, with a ± too wide"),
        ("1e300, uncertainty = 1.0".to_owned(), "wrong by more"),
        (format!("{}, uncertainty = 0.1", -truth), "Its sign is wrong."),
        (format!("{}, uncertainty = 1e-9", truth * ARCSEC_RAD), "looks like rad"),
        (format!("{}, uncertainty = 1e-9", truth / 3600.0), "looks like degrees"),
    ];
    for (number, why) in spoiled {
        let answer = good.replace(size, &format!("size = {{ value = {number} }}"));
        let marked = graded(&key, student, &answer, &true_one(&task));
        assert_eq!(marked.points, full() - 2.0);
        let told = &of(&marked, Item::Size).why;
        assert!(told.contains(why) && told.len() < 200, "{marked:?}");
    }
    for (right, wrong, item, why) in [
        ("sentence = 2", "sentence = \"2\"", Item::Honesty, "write it as `sentence = 2`"),
        ("causes = [", "causes = [3, ", Item::Cause, "no list of words"),
        ("sentence = 2", "sentense = 2", Item::Honesty, "You chose no sentence"),
    ] {
        let marked = graded(&key, student, &good.replace(right, wrong), &true_one(&task));
        assert!(of(&marked, item).why.contains(why), "{marked:?}");
        assert_eq!(marked.points, full() - of(&marked, item).of, "{marked:?}");
        assert_eq!(feedback(&marked).contains("asks for no sentense"), wrong.starts_with("sentense"));
    }
    let answer = good.replace(task.effects[0].cause.word(), "witchcraft").replace("as_labelled", "backwards");
    let marked = graded(&key, student, &answer, &true_one(&task));
    assert_eq!(marked.points, full() - 4.0);
    assert!(of(&marked, Item::Cause).why.contains("`witchcraft` is no cause"), "{marked:?}");
    assert!(of(&marked, Item::Place).why.contains("`backwards` is no reading"), "{marked:?}");
    let bare = task.instrument.declaration;
    let long = format!("{bare}{}", " ".repeat(70_000));
    let strange =
        bare.replacen("body", "input pressure; body", 1).replacen("Rx(tilt_x)", "Rx(tilt_x*pressure)", 1);
    let chains = [
        ("", "has a mistake"),
        ("chain X {\n body }", "has a mistake in line 2: "),
        ("chain X {}", "the declaration"),
        (long.as_str(), "more than"),
        (strange.as_str(), "needs readings of `pressure`"),
        (
            "chain X { body a on ground { position_error: Rz(e); } observe other: direction(1, 0, 0) of a; }",
            "shows no direction",
        ),
    ];
    for (chain, why) in chains {
        let marked = graded(&key, student, &good, chain);
        assert_eq!(marked.points, full() - 8.0, "{marked:#?}");
        assert!(of(&marked, Item::Place).why.contains(why), "{chain}: {marked:?}");
    }
    let handed = Handed { answer: Ok(good), declaration: Err("there is no `amended.chain`".to_owned()) };
    let marked = grade(&key, student, &handed).unwrap();
    assert_eq!(marked.points, full() - 8.0);
    assert!(feedback(&marked).contains("there is no `amended.chain`"), "{}", feedback(&marked));
}

/// However a word of the sheet is written, and whatever stands beside it.
#[test]
fn a_cause_counts_beside_one_that_there_is_not() {
    let (_, key, _) = class(&["Ada"], 2);
    let student = &key.students[0];
    let task = key.task(student).unwrap();
    let [one, other] = [0, 1].map(|at| words(&task.effects[at].possible));
    let good = perfect(&task, &student.mark);
    for (from, to, points) in [
        (one.as_str(), format!(" {} ", one.to_uppercase().replace('_', " ")), 4.0),
        (one.as_str(), "witchcraft".to_owned(), 2.0),
        (other.as_str(), format!("{other} or witchcraft"), 3.0),
        (other.as_str(), format!("{other}\", \"witchcraft"), 2.5),
    ] {
        let marked = graded(
            &key,
            student,
            &good.replace(&format!("\"{from}\""), &format!("\"{to}\"")),
            &true_one(&task),
        );
        let grade = of(&marked, Item::Cause);
        assert_eq!(grade.points, points, "{to}: {grade:?}");
        assert_eq!(grade.why.contains("`witchcraft` is no cause"), to.contains("witchcraft"), "{grade:?}");
    }
}

/// Joints that are none, names of declared errors for other things, amounts that have no value, nothing to fit.
#[test]
fn strange_declarations_are_graded_without_harm() {
    let (_, key, _) = class(&["Ada"], 1);
    let student = &key.students[0];
    let task = key.task(student).unwrap();
    let good = perfect(&task, &student.mark);
    let [first, second] = task.instrument.joints();
    let bare = task.instrument.declaration;
    let strange = [
        "chain X { body a on ground { position: Rz(pi/2); } observe pointing: direction(1, 0, 0) of a; }"
            .to_owned(),
        format!(
            "chain X {{ const {first}: angle = 1; const tilt_x: angle = 2; body a on ground {{ position: Rz({first}), Rx(tilt_x); \
             position_error: Rz({second}); }} observe pointing: direction(1, 0, 0) of a; }}"
        ),
        bare.replacen("Rx(tilt_x)", &format!("Rx(tilt_x), Rx(far*tan({first})*tan(2*{first}))"), 1),
        bare.replacen("Rx(tilt_x)", "Rx(tilt_x), Rx(never*cot(0*pi))", 1),
        bare.replacen("Rx(tilt_x)", "Rx(tilt_x), Tx(shift), Rx(far*1e300), Rx(near*1e-300)", 1),
    ];
    for declaration in strange {
        let marked = graded(&key, student, &good, &declaration);
        assert!(of(&marked, Item::Place).points < 5.0, "{declaration}\n{marked:#?}");
        assert!(marked.points >= full() - 8.0);
    }
}
