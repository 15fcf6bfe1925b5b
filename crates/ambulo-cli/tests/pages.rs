//! `ambulo report` and `ambulo view`: the page of a folder, and errors.

use crate::workbench::{FORCES, Workbench};

/// A folder with the results of the recording.
fn bench(name: &str) -> Workbench {
    let bench = Workbench::new(name);
    bench.run(&FORCES).done();
    bench
}

#[test]
fn a_page_written_again_equals_the_page_of_the_run() {
    let bench = bench("page-anew");
    let first = bench.text("out/report.html");
    std::fs::remove_file(bench.folder.join("out/report.html")).unwrap();
    bench.run(&["report", "out"]).done();
    assert!(bench.text("out/report.html") == first, "the page written again differs");
    // `view` writes the page if a folder has none.
    std::fs::remove_file(bench.folder.join("out/report.html")).unwrap();
    let run = bench.run(&["view", "out"]).done();
    assert!(run.stdout.contains("report.html") && bench.text("out/report.html") == first, "{}", run.stdout);
}

#[test]
fn a_page_loads_nothing_from_the_network_and_is_small() {
    let bench = bench("page-offline");
    let page = bench.text("out/report.html");
    for asked in ["src=\"http", "href=\"http", "@import", "url(http"] {
        assert!(!page.contains(asked), "{asked}");
    }
    assert!(page.contains("default-src 'none'") && page.len() < 1_500_000, "{} bytes", page.len());
}

#[test]
fn two_and_three_runs_are_shown_on_one_page() {
    let bench = bench("page-compared");
    let copy = |to: &str| {
        std::fs::create_dir_all(bench.folder.join(to)).unwrap();
        for file in std::fs::read_dir(bench.folder.join("out")).unwrap() {
            let file = file.unwrap().path();
            if file.is_file() {
                std::fs::copy(&file, bench.folder.join(to).join(file.file_name().unwrap())).unwrap();
            }
        }
    };
    copy("b/out");
    copy("c");
    bench.run(&["report", "out", "--compare", "b/out", "--compare", "c", "-o", "three.html"]).done();
    let page = bench.text("three.html");
    // Folders with the same name are shown with their path.
    assert!(page.contains("<title>out / b/out / c - Ambulo</title>"), "{}", &page[..400]);
    bench
        .run(&["report", "out", "--compare", "c", "--compare", "c", "--compare", "c"])
        .refused(&["found 3 folders", "at most 2"]);
}

#[test]
fn anything_but_a_result_folder_is_rejected_with_a_hint() {
    let bench = bench("page-refused");
    std::fs::create_dir_all(bench.folder.join("empty")).unwrap();
    std::fs::create_dir_all(bench.folder.join("paper")).unwrap();
    bench.write("paper/claims.json", "[]");
    bench.run(&["report", "nothing"]).refused(&["nothing", "no such folder", "hint:"]);
    bench.run(&["report", "empty"]).refused(&["empty", "found no summary.json"]);
    bench.run(&["report", "paper"]).refused(&["`ambulo reproduce` wrote this folder"]);
    bench.run(&["report", "out/report.html"]).refused(&["this is a file", "its folder is out"]);
    bench.run(&["report", "out", "-o", "page.txt"]).refused(&["ends in .html"]);
    bench.run(&["view", "walk.mot"]).refused(&["not a page"]);
    bench.run(&["view", "nothing"]).refused(&["no such file or folder"]);
    bench.run(&["convert", "nothing", "x.glb"]).refused(&["no such file or folder"]);
    bench.run(&["convert", "empty", "x.glb"]).refused(&["found no summary.json"]);
    bench.write("out/summary.json", bench.text("out/summary.json").replace("\"run_id\"", "\"run\""));
    bench.run(&["report", "out"]).refused(&["summary.json: found no valid `run_id`", "an earlier version", "--force"]);
    bench.write("out/summary.json", "{");
    bench.run(&["report", "out"]).refused(&["summary.json"]);
}
