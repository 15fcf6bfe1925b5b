//! The page of `ambulo reproduce`: figures and claims of the 1997 paper with our results.
//!
//! The drawings of the paper are not included; its captions and a summary of its text are next to our figures.

use super::figures::moving_picture;
use super::html::{Document, escaped};
use ambulo_paper::{
    Claim, Evidence, Numbers, Sensitivity, Setting, assumptions, moving_figure, number, stored_shares, tally,
};
use ambulo_results::{OutputFile, PAGE};
use std::fmt::Write;

const STYLE: &str = include_str!("../data/report/page.css");
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

/// A figure of the paper.
struct Figure {
    /// Number of the figure and of the file.
    number: u8,
    /// Caption in the paper.
    caption: &'static str,
    /// Summary of the text of the paper.
    says: &'static str,
    /// Differences of our figure.
    here: &'static str,
    /// Ids of the claims about this figure.
    claims: &'static [&'static str],
}

/// Faure, Debunne, Cani, Multon 1997: captions as printed, contents of sections 2, 4 and 5 in short.
const FIGURES: [Figure; 7] = [
    Figure {
        number: 1,
        caption: "Angular laws of the limbs and locomotion sub-cycles during human walking.",
        says: "Each joint has its own sub-cycles: the knee extends in three phases (E1, E2, E3) and flexes in one (F); \
            their times are linear in speed.",
        here: "Nilsson's tables are not available: the curves are laws fitted to published means of walking.",
        claims: &[],
    },
    Figure {
        number: 2,
        caption: "Approximation of the knee angle trajectory by 5-degree polynomial.",
        says: "Between two bounds the angle is a polynomial of degree 5 with zero first and second derivatives at both \
            bounds.",
        here: "The figure also shows the measured curve that defines the bounds.",
        claims: &["l1", "l2", "l3"],
    },
    Figure {
        number: 3,
        caption: "Snapshots of the motion, during a step.",
        says: "A cycle of one second, which the paper calls a slow walk. The trunk keeps its angle to the ground; the \
            driven legs move the body forwards.",
        here: "",
        claims: &["c1", "c3", "c4", "d1", "d2", "k"],
    },
    Figure {
        number: 4,
        caption: "Computed torques for the hip, the knee and the ankle of a leg during a step.",
        says: "At 30 Hz the torques are rather continuous and have a period of one second. Hip and knee have a similar \
            shape, the hip is larger, the ankle is lower. The torques are high: the paper estimates 576 N.m on \
            average.",
        here: "Impulses of foot impacts are not part of the torques.",
        claims: &["a1", "a2", "b", "c2", "h1", "h2", "h3", "h4", "m2"],
    },
    Figure {
        number: 5,
        caption: "Action on the ground during the support phase. Measured (a) and computed (b) exhibit similarities.",
        says: "The figure of 80 kg bounces when the foot hits the ground, and there is an unwanted flight phase; \
            otherwise the force is quite similar to measured curves.",
        here: "The measured curve is the mean of Schwartz, Rozumalski, Trost 2008 instead of the measurements cited in \
            the paper.",
        claims: &["e1", "e2", "e3", "e4", "i"],
    },
    Figure {
        number: 6,
        caption: "Influence of the mass of the human figure on the hip torques.",
        says: "Amplitudes change nearly in proportion to the weight, and the shape stays the same; in the swing phase \
            the torques change slightly.",
        here: "",
        claims: &["f1", "f2"],
    },
    Figure {
        number: 7,
        caption: "Comparison of the different gaits, here shown with the computed torque for the knee.",
        says: "Standard, long (1 s), short (0.62 s) and goose steps (0.82 s) have the same global shape after time \
            scaling; short steps have the lowest torques and the most regular velocity.",
        here: "",
        claims: &["g1", "g2", "g3", "j", "m1"],
    },
];

/// `report.html` of a reproduction: claims, walks of each mode, and `files`, those of [`super::reproduction_files`].
#[must_use]
pub fn reproduction_page(
    claims: &[Claim],
    modes: &[(&str, &Evidence)],
    setting: &Setting,
    sensitivities: &[Sensitivity],
    files: &[OutputFile<'_>],
) -> OutputFile<'static> {
    let [held, total] = tally(claims);
    let figures: String = FIGURES.iter().map(|figure| figure.section(claims, files)).collect();
    let body = format!(
        r#"<header>
<h1>Dynamic analysis of human walking, recomputed</h1>
<p>F. Faure, G. Debunne, M.-P. Cani, F. Multon, 8th Eurographics Workshop on Computer Animation and Simulation, 1997. Its walks are simulated in
<b>the paper's mode</b> (rigid soles, joints driven by its curves, trunk held upright) and in a <b>corrected mode</b> (soft shoes, a moving trunk, no
residual forces). Claims are judged in the paper's mode; the number of the corrected mode is given for comparison.</p>
<p><b>{held} of {total} claims of the paper hold</b>, apart from those that are true by construction and those that are ours. <span class="soft">Ambulo {version}</span></p>
</header>
<main>
<h2>Moving pictures</h2>
<p class="soft">One cycle of the steady walk, seen from the right; left limbs are grey. The figure stays in the picture, and the marks on the ground
move at its speed.</p>
{moving}
<h2>Figures</h2>
<p class="soft">The drawings of the paper are not included. The captions and a summary of the text of the paper are next to our figures.</p>
{figures}
<h2>Claims</h2>
{claims}
<h2>What the paper does not give</h2>
{assumptions}
</main>"#,
        moving = moving_pictures(modes),
        version = env!("CARGO_PKG_VERSION"),
        claims = claim_table(claims),
        assumptions = assumption_table(claims, setting, sensitivities),
    );
    let page = Document {
        title: "Dynamic analysis of human walking, 1997, recomputed",
        policy: POLICY,
        style: STYLE,
        body: &body,
    };
    OutputFile::new(PAGE, page.html().into_bytes())
}

/// The four gaits in each mode.
fn moving_pictures(modes: &[(&str, &Evidence)]) -> String {
    let mut html = String::new();
    for (mode, evidence) in modes {
        let _ = write!(html, "<h3>{}</h3>\n<div class=\"walks\">", escaped(mode));
        for figure in evidence.gaits.iter().filter_map(moving_figure) {
            let label = format!("{}, {:.2} s", figure.gait, figure.cycle_s);
            let picture = moving_picture(&figure, &escaped(&format!("{label}, {mode}")));
            let _ = writeln!(html, "<figure>{picture}<figcaption>{}</figcaption></figure>", escaped(&label));
        }
        html += "</div>\n";
    }
    html
}

/// The text of a file of the run.
fn svg_of(files: &[OutputFile<'_>], name: &str) -> Option<String> {
    let file = files.iter().find(|file| file.name == name)?;
    String::from_utf8(file.bytes().ok()?).ok()
}

impl Figure {
    fn section(&self, claims: &[Claim], files: &[OutputFile<'_>]) -> String {
        let Figure { number, caption, says, here, .. } = self;
        let here = if here.is_empty() { String::new() } else { format!("\n<p class=\"soft\">Here: {here}</p>") };
        let own: String = claims.iter().filter(|claim| self.claims.contains(&claim.id)).map(line).collect();
        let list = if own.is_empty() { String::new() } else { format!("<ul>{own}</ul>") };
        format!(
            "<section class=\"figure\" aria-label=\"Figure {number}\">\n<div>\n<h3>Figure \
             {number}</h3>\n<p>{}</p>\n<p>{says}</p>{here}\n\
             <p class=\"soft\">Numbers: figures/figure{number}.csv</p>\n</div>\n<div>{list}</div>\n<div \
             class=\"picture\">{}</div>\n</section>\n",
            escaped(&format!("\u{201c}{caption}\u{201d}")),
            picture(files, *number),
        )
    }
}

/// A figure as SVG, or a message if it could not be drawn.
fn picture(files: &[OutputFile<'_>], number: u8) -> String {
    let name = format!("figures/figure{number}.svg");
    match svg_of(files, &name) {
        Some(svg) => svg.replacen("<svg ", &format!("<svg aria-label=\"Figure {number} as computed here\" "), 1),
        None => format!("Figure {number} could not be drawn."),
    }
}

/// A claim in the list of its figure.
fn line(claim: &Claim) -> String {
    format!("<li>{} <a href=\"#{id}\">{id}</a> {}</li>\n", mark(claim), escaped(claim.paper), id = claim.id)
}

fn mark(claim: &Claim) -> &'static str {
    if claim.pass { "<span class=\"holds\">✓ holds</span>" } else { "<span class=\"fails\">✗ fails</span>" }
}

fn claim_table(claims: &[Claim]) -> String {
    let mut html = String::from(
        "<div class=\"scroll\"><table>\n<caption>The names of the numbers include the units. All numbers are in \
         claims.json.</caption>\n\
         <thead><tr><th scope=\"col\">Claim</th><th scope=\"col\">Verdict</th><th scope=\"col\">Kind</th><th \
         scope=\"col\">Share of settings</th><th scope=\"col\">Statement of the paper</th><th scope=\"col\">Number</th>\
         <th scope=\"col\" class=\"number\">Paper's mode</th><th scope=\"col\" \
         class=\"number\">Corrected</th></tr></thead>\n<tbody>\n",
    );
    for claim in claims {
        let corrected = claim.corrected.as_ref().map_or(f64::NAN, |numbers| number(numbers, claim.headline));
        let _ = writeln!(
            html,
            "<tr id=\"{id}\"><th \
             scope=\"row\">{id}</th><td>{}</td><td>{}</td><td>{}</td><td>{}<details><summary>reason and all \
             numbers</summary><p>Holds if {}. \
             {}</p>{}</details></td>\
             <td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td></tr>",
            mark(claim),
            claim.kind.words(),
            escaped(&stored_shares().words(claim)),
            escaped(claim.paper),
            escaped(claim.criterion),
            escaped(&claim.note),
            all_numbers(&claim.paper_mode, claim.corrected.as_ref()),
            escaped(claim.headline),
            shown(claim.value()),
            shown(corrected),
            id = claim.id,
        );
    }
    html + "</tbody></table></div>"
}

fn all_numbers(paper: &Numbers, corrected: Option<&Numbers>) -> String {
    let mut html = String::from(
        "<table><thead><tr><th scope=\"col\">number</th><th scope=\"col\" class=\"number\">paper's mode</th><th \
         scope=\"col\" class=\"number\">corrected</th></tr></thead><tbody>",
    );
    for (name, value) in paper {
        let other = corrected.map_or(f64::NAN, |numbers| number(numbers, name));
        let _ = write!(
            html,
            "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td></tr>",
            escaped(name),
            shown(*value),
            shown(other)
        );
    }
    html + "</tbody></table>"
}

/// The assumptions, and the claims whose verdict changes with other values.
fn assumption_table(claims: &[Claim], setting: &Setting, sensitivities: &[Sensitivity]) -> String {
    let mut html = String::from(
        "<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">Quantity</th><th scope=\"col\">Value</th><th \
         scope=\"col\">Reason</th>\
         <th scope=\"col\">Claims that change with other values</th></tr></thead>\n<tbody>\n",
    );
    for assumption in assumptions(setting) {
        let own = sensitivities.iter().filter(|sensitivity| sensitivity.what == assumption.what);
        let turned: Vec<String> = own
            .map(|sensitivity| match &sensitivity.outcome {
                Err(reason) => format!("{}: {reason}", sensitivity.other),
                Ok(_) => match &sensitivity.reversed(claims)[..] {
                    [] => format!("{}: none", sensitivity.other),
                    turned => format!("{}: {}", sensitivity.other, turned.join(", ")),
                },
            })
            .collect();
        let turned = if turned.is_empty() { "not tested".to_owned() } else { turned.join("; ") };
        let cells = [&assumption.what, &assumption.value, assumption.why, &turned].map(escaped);
        let _ = writeln!(
            html,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>",
            cells[0], cells[1], cells[2], cells[3]
        );
    }
    html + "</tbody></table></div>"
}

/// Three significant digits, or a dash if there is no number.
fn shown(value: f64) -> String {
    let size = value.abs();
    match size {
        _ if !value.is_finite() => "-".to_owned(),
        _ if size < f64::MIN_POSITIVE => "0".to_owned(),
        1e5.. => format!("{value:.1e}"),
        100.0.. => format!("{value:.0}"),
        10.0.. => format!("{value:.1}"),
        1.0.. => format!("{value:.2}"),
        0.001.. => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    }
}
