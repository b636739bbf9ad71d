//! The words of the tour, with the scenes and the numbers that they speak of.

use super::{Beat, Claim, KnobSetting, Lesson, LessonFigure, Staging};
use crate::sim::Knob;
use crate::tui::app::MapKind::{Contact, Film, Pressure, Roughness, Stress};
use KnobSetting::{TimesHome, To};
use LessonFigure::{
    ContactPercent, Counted1, Counted2, Lambda, LeftPercent, Life, N1, N2, PaperLife, PeakDepth,
    PeakPressure,
};

const S: Knob = Knob::SlideRoll;
const SPEED: Knob = Knob::EntrainmentMS;
const A1: Knob = Knob::Amplitude1M;
const A2: Knob = Knob::Amplitude2M;

const fn claim(figure: LessonFigure, least: f64, most: f64) -> Claim {
    Claim {
        figure,
        least,
        most,
    }
}

const fn on(preset: &'static str, sets: &'static [&'static str]) -> Staging {
    Staging { preset, sets }
}

const ROLLERS: &str = "demonstration";
/// Finely ground flanks of 0.02 mm waves: 2a/W = 19.5.
const FLANKS: Staging = on(
    "fzg_pitch_point",
    &[
        "grid.nodes=257",
        "body_1.surface.wavelength_x_m=2.047e-5",
        "body_2.surface.wavelength_x_m=2.047e-5",
        "body_1.surface.amplitude_m=3e-8",
        "body_2.surface.amplitude_m=3e-8",
    ],
);

const FAST: Staging = on(
    ROLLERS,
    &[
        "motion.entrainment_m_s=1.6",
        "body_1.surface.amplitude_m=1.5e-7",
        "body_2.surface.amplitude_m=1.5e-7",
        "friction.contact_film_m=2e-8",
    ],
);
const NEARLY_DRY: Staging = on(
    ROLLERS,
    &[
        "motion.entrainment_m_s=0.02",
        "body_1.surface.amplitude_m=1.5e-7",
        "body_2.surface.amplitude_m=1.5e-7",
        "friction.contact_film_m=2e-8",
    ],
);
const SHORT_WAVES: Staging = on(
    ROLLERS,
    &[
        "motion.slide_roll=0",
        "motion.entrainment_m_s=1",
        "body_1.surface.amplitude_m=1.5e-7",
        "body_2.surface.kind=smooth",
    ],
);
const LONG_WAVES: Staging = on(
    ROLLERS,
    &[
        "motion.slide_roll=0",
        "motion.entrainment_m_s=1",
        "body_1.surface.amplitude_m=1.5e-7",
        "body_1.surface.wavelength_x_m=6e-4",
        "body_2.surface.kind=smooth",
    ],
);

/// The lessons, in order.
pub const LESSONS: &[Lesson] = &[
    Lesson {
        title: "One asperity, one passage",
        beats: &[
            Beat {
                staging: Some(on(
                    ROLLERS,
                    &["motion.slide_roll=0", "body_2.surface.kind=smooth"],
                )),
                caption: "Pure rolling, S = 0, only body 1 is rough. Follow the diamond: a point of the surface crosses the contact and is pressed once, n = 1.",
                map: Some(Pressure),
                passages: 1.5,
                claims: &[
                    claim(N1, 1.0, 1.0),
                    claim(Counted1, 0.8, 1.2),
                    claim(N2, 1.0, 1.0),
                    claim(Counted2, 0.8, 1.2),
                ],
                ..Beat::PLAIN
            },
            Beat {
                caption: "Its ridges cross with it: pressure peaks stand on them, but they stay the same peaks. Not modelled: heat, wear; yield is left out here.",
                map: Some(Pressure),
                passages: 2.0,
                claims: &[claim(Counted1, 0.8, 1.2), claim(PeakPressure, 1.1, 3.0)],
                ..Beat::PLAIN
            },
        ],
    },
    Lesson {
        title: "Rolling against sliding: why the count explodes",
        beats: &[
            Beat {
                staging: Some(FLANKS),
                caption: "Two finely ground flanks, rolling: S = 0. Both surfaces move in step and each point is pressed once: n = 1. Pin this (b) to compare.",
                map: Some(Pressure),
                passages: 2.0,
                claims: &[claim(N1, 1.0, 1.0), claim(Counted1, 0.8, 1.2)],
                ..Beat::PLAIN
            },
            Beat {
                caption: "S = 0.1: the mate's crests now overtake the point while it crosses, three by formula. But oil lets such low ripples go: one cycle is counted.",
                sets: &[(S, To(0.1))],
                passages: 2.5,
                claims: &[claim(N1, 2.8, 3.2), claim(Counted1, 0.8, 1.6)],
                ..Beat::PLAIN
            },
            Beat {
                caption: "S = 0.5: the trace below has become a comb, n = 14, of which ten are counted. Each tooth taken for a whole cycle, as in the paper, life falls to 0.07.",
                sets: &[(S, To(0.5))],
                passages: 3.0,
                claims: &[
                    claim(N1, 13.5, 14.5),
                    claim(Counted1, 8.5, 11.5),
                    claim(PaperLife, 0.05, 0.09),
                ],
                ..Beat::PLAIN
            },
            Beat {
                caption: "But the teeth are low, and n an upper bound. Each by the damage it does, they cost next to nothing: life is 0.95. Not modelled: wear, which can reverse the trend with S.",
                passages: 1.0,
                claims: &[
                    claim(N1, 13.5, 14.5),
                    claim(Counted1, 8.5, 11.5),
                    claim(N2, 8.0, 10.0),
                    claim(Counted2, 3.5, 6.5),
                    claim(Life, 0.9, 1.0),
                ],
                ..Beat::PLAIN
            },
        ],
    },
    Lesson {
        title: "Thin film: from λ = 5 to dry",
        beats: &[
            Beat {
                staging: Some(FAST),
                caption: "Fast: the film is five times as thick as the roughness, λ = 5. Nothing touches; the film's horseshoe shows.",
                map: Some(Film),
                passages: 1.5,
                claims: &[claim(Lambda, 4.5, 5.5), claim(ContactPercent, 0.0, 0.01)],
                ..Beat::PLAIN
            },
            Beat {
                caption: "An eighth of the speed: λ = 1.2, ripples and film are alike, pressure peaks grow.",
                sets: &[(SPEED, TimesHome(0.125))],
                map: Some(Film),
                passages: 2.0,
                claims: &[claim(Lambda, 1.0, 1.4), claim(PeakPressure, 1.2, 3.0)],
                ..Beat::PLAIN
            },
            Beat {
                staging: Some(NEARLY_DRY),
                caption: "A tenth of that: nearly dry. Half of the contact touches and rubs there with the boundary friction. Not modelled: heat, which would thin the oil further.",
                map: Some(Contact),
                passages: 1.0,
                claims: &[claim(Lambda, 0.1, 0.3), claim(ContactPercent, 40.0, 85.0)],
                ..Beat::PLAIN
            },
        ],
    },
    Lesson {
        title: "Waves that flatten",
        beats: &[
            Beat {
                staging: Some(SHORT_WAVES),
                caption: "Short waves, 0.2 mm (W/a = 0.43), as they were ground. Under pressure some 60 % of their height is left in the film, where it rolls.",
                map: Some(Roughness),
                passages: 1.5,
                claims: &[claim(LeftPercent, 50.0, 70.0)],
                ..Beat::PLAIN
            },
            Beat {
                staging: Some(LONG_WAVES),
                caption: "Waves three times as long: the contact presses them flat, a fifth is left in the film. Its ripple, not the heights, is what λ should know.",
                map: Some(Film),
                passages: 1.5,
                claims: &[claim(LeftPercent, 12.0, 28.0)],
                ..Beat::PLAIN
            },
            Beat {
                caption: "Now they slide, S = 1: oil drawn over the slow ridges presses them flatter still, a seventh is left. Not modelled: heat; no yield here.",
                sets: &[(S, To(1.0))],
                map: Some(Film),
                passages: 2.0,
                claims: &[claim(LeftPercent, 11.0, 19.0)],
                ..Beat::PLAIN
            },
        ],
    },
    Lesson {
        title: "Transverse, longitudinal, isotropic",
        beats: &[
            Beat {
                staging: Some(on(
                    ROLLERS,
                    &[
                        "body_1.surface.kind=smooth",
                        "body_2.surface.wavelength_y_m=inf",
                    ],
                )),
                caption: "Only body 2 is rough, with ridges across the motion; S = 0.5. Its crests overtake body 1 one by one: n₁ = 4. Its own n₂ is 1.",
                map: Some(Pressure),
                passages: 2.5,
                claims: &[
                    claim(N1, 3.8, 4.5),
                    claim(Counted1, 2.8, 4.5),
                    claim(N2, 1.0, 1.0),
                    claim(Counted2, 0.8, 1.2),
                ],
                ..Beat::PLAIN
            },
            Beat {
                staging: Some(on(
                    ROLLERS,
                    &[
                        "body_1.surface.kind=smooth",
                        "body_2.surface.wavelength_x_m=inf",
                    ],
                )),
                caption: "The same ridges along the motion: no crest passes a point, n₁ = 1 at any S. Peaks are there all the same.",
                map: Some(Pressure),
                passages: 2.5,
                claims: &[
                    claim(N1, 1.0, 1.0),
                    claim(Counted1, 0.8, 1.2),
                    claim(PeakPressure, 1.05, 3.0),
                ],
                ..Beat::PLAIN
            },
            Beat {
                staging: Some(on(ROLLERS, &["body_1.surface.kind=smooth"])),
                caption: "Isotropic: bumps both ways. As many crests as across, half the ground between them. Not modelled: real lay, which is never one wave.",
                map: Some(Pressure),
                passages: 2.5,
                claims: &[claim(N1, 3.8, 4.5), claim(Counted1, 2.8, 4.5)],
                ..Beat::PLAIN
            },
        ],
    },
    Lesson {
        title: "A gear tooth from dedendum to tip",
        beats: &[
            Beat {
                staging: Some(on("fzg_point_a", &[])),
                caption: "Pinion's dedendum, where contact begins: S = 1.3. Body 1, the pinion, is the slower and meets most crests: n₁ 7, n₂ 2. Here pits begin.",
                map: Some(Pressure),
                passages: 3.5,
                claims: &[
                    claim(N1, 6.5, 7.2),
                    claim(Counted1, 5.3, 7.2),
                    claim(N2, 2.0, 2.4),
                    claim(Counted2, 1.2, 2.4),
                    claim(PeakPressure, 1.2, 2.5),
                ],
                ..Beat::PLAIN
            },
            Beat {
                staging: Some(on("fzg_pitch_point", &[])),
                caption: "Pitch point: one pair carries all the load, and rolls: S = 0, n = 1 for both. 1.3 are counted: the oil adds small cycles of its own (dry: 1.0).",
                map: Some(Pressure),
                passages: 1.5,
                claims: &[
                    claim(N1, 1.0, 1.0),
                    claim(Counted1, 0.8, 1.6),
                    claim(N2, 1.0, 1.0),
                    claim(Counted2, 0.8, 1.6),
                ],
                ..Beat::PLAIN
            },
            Beat {
                staging: Some(on("fzg_point_e", &[])),
                caption: "Pinion's tip: S = −1.04, now the wheel is the slower: n₂ 6, n₁ 2.5. Not modelled: a tooth passes through all this in a millisecond; each point here stands.",
                map: Some(Pressure),
                passages: 2.5,
                claims: &[
                    claim(N1, 2.3, 2.8),
                    claim(Counted1, 1.4, 2.8),
                    claim(N2, 5.5, 6.2),
                    claim(Counted2, 4.3, 6.2),
                    claim(PeakPressure, 1.2, 3.0),
                ],
                ..Beat::PLAIN
            },
        ],
    },
    Lesson {
        title: "Where does the pit start?",
        beats: &[
            Beat {
                staging: Some(on(ROLLERS, &["motion.slide_roll=0"])),
                caption: "Stress below the surface. Smooth: the maximum lies at about half the contact's half-width, deep below.",
                sets: &[(A1, To(0.0)), (A2, To(0.0))],
                map: Some(Stress),
                passages: 1.5,
                claims: &[claim(PeakDepth, 0.4, 0.55)],
            },
            Beat {
                caption: "Rough: each pressure peak puts a stress peak just under the skin. The maximum moves towards the surface, and pits with it.",
                sets: &[(A1, TimesHome(1.0)), (A2, TimesHome(1.0))],
                map: Some(Stress),
                passages: 1.5,
                claims: &[claim(PeakDepth, 0.0, 0.3), claim(PeakPressure, 1.3, 4.0)],
                ..Beat::PLAIN
            },
            Beat {
                caption: "And sliding: friction pulls it up further, and cycles multiply. Not modelled: residual stress, shakedown of the asperities, inclusions.",
                sets: &[(S, To(1.0))],
                map: Some(Stress),
                passages: 2.0,
                claims: &[
                    claim(PeakDepth, 0.0, 0.3),
                    claim(Counted2, 2.3, 4.4),
                    claim(N2, 3.8, 4.5),
                ],
                ..Beat::PLAIN
            },
        ],
    },
];
