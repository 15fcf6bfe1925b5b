//! The outputs that a run writes.

use ambulo_results::Keep;

fn keep(names: &[&str]) -> Keep {
    Keep::of_names(&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>())
}

#[test]
fn a_list_includes_its_outputs_and_the_summary() {
    let files = [
        "moments.sto",
        "grf.mot",
        "external_loads.xml",
        "grf_sd.mot",
        "report.html",
        "figures/moments.svg",
        "subject.osim",
        "input/walk.c3d",
        "summary.json",
        "timings.json",
    ];
    let of = |names: &[&str]| files.into_iter().filter(|file| keep(names).includes(file)).collect::<Vec<_>>();
    assert_eq!(of(&["moments", "grf"]), ["moments.sto", "grf.mot", "external_loads.xml", "summary.json"]);
    assert_eq!(of(&["tables"]), ["moments.sto", "grf.mot", "external_loads.xml", "grf_sd.mot", "summary.json"]);
    assert_eq!(of(&["figures", "report"]), ["report.html", "figures/moments.svg", "summary.json"]);
    assert_eq!(of(&["model", "recording"]), ["subject.osim", "input/walk.c3d", "summary.json"]);
    assert_eq!(of(&["summary"]), ["summary.json"]);
    assert_eq!(of(&["timings"]), ["summary.json", "timings.json"]);
    assert_eq!(of(&[]), files);
}

#[test]
fn a_page_needs_all_tables() {
    assert_eq!(keep(&["report"]).needed(), Keep::all());
    assert_eq!(keep(&["moments"]).needed(), keep(&["moments"]));
}
