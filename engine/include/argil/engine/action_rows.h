// SPDX-License-Identifier: GPL-3.0-or-later
// The table of actions: a row for each, from which the enumeration, the engine's dispatch, scripts,
// the command line and the window take theirs (argil/engine/action.h). To be included wherever
// ARGIL_ACTION(name, kind, fields of ActionInfo...) is defined, as often as needed; each time it
// undefines it.
//
// The order is that of the numbers of `Action`: a new row goes to the end. Its function
// `actions::NAME` lies in engine/src/action/action_NAME.cpp and has the form of its kind
// (action/action.h there). A row without its function does not link, a function of another kind and
// a row that lacks something do not compile.
#ifndef ARGIL_ACTION
#define ARGIL_ACTION(name, kind, ...)
#endif

/// Union with the tool. The shape is shrunk inward by (1 - strength) of its smallest radius.
ARGIL_ACTION(add, stamped, .opposite = Action::carve, .place = 30, .key = 'A', .title = "Add",
             .help = "adds the tool's shape; Ctrl carves it",
             .picture = {.after = {.ball = 1.0F}, .hand = HandMark::circle})

/// The tool is cut away. The shape is shrunk as that of add.
ARGIL_ACTION(carve, stamped, .is_cut = true, .opposite = Action::add, .place = 40, .key = 'C',
             .title = "Carve", .help = "cuts the tool's shape away; Ctrl adds it",
             .picture = {.after = {.ball = -1.0F}, .hand = HandMark::circle})

/// The surface is drawn to its average. The strength is how far it goes there per quarter radius of
/// path.
ARGIL_ACTION(smooth, local, .curves = Curves::all, .place = 20, .key = 'S', .title = "Smooth",
             .help = "draws the surface to its average; also Shift with any tool",
             .picture = {
                 .before = {.wave = 0.20F}, .after = {.wave = 0.04F}, .hand = HandMark::across})

/// The surface moves along its normal; negative strengths deflate. 1 moves the middle out by a
/// quarter of the smallest radius per pass.
ARGIL_ACTION(inflate, local, .is_signed = true, .curves = Curves::all, .place = 10, .key = 'D',
             .title = "Draw", .help = "raises the surface along its normal; Ctrl lowers it",
             .picture = {.after = {.bump = 0.5F, .left = 0.8F, .right = 0.8F},
                         .hand = HandMark::rise})

/// Drawn to the plane that fits the surface under the tool, from both sides. The strength as of
/// smooth.
ARGIL_ACTION(flatten, local, .curves = Curves::all, .place = 60, .key = 'L', .title = "Flatten",
             .help = "to the plane under the tool, from both sides",
             .picture = {.before = {.wave = 0.20F},
                         .after = {.wave = 0.20F, .floor = 0.0F, .ceiling = 0.0F},
                         .hand = HandMark::press})

/// Only what stands above that plane. The strength as of smooth.
ARGIL_ACTION(scrape, local, .curves = Curves::all, .opposite = Action::fill, .place = 70,
             .key = 'R', .title = "Scrape", .help = "only what stands above that plane; Ctrl fills",
             .picture = {.before = {.wave = 0.20F},
                         .after = {.wave = 0.20F, .ceiling = 0.0F},
                         .hand = HandMark::blade})

/// Only what lies below it. The strength as of smooth.
ARGIL_ACTION(fill, local, .curves = Curves::all, .opposite = Action::scrape, .place = 80,
             .key = 'B', .title = "Fill", .help = "only what lies below that plane; Ctrl scrapes",
             .picture = {.before = {.wave = 0.20F},
                         .after = {.wave = 0.20F, .floor = 0.0F},
                         .hand = HandMark::pour})

/// Matter moves towards the tool's axis; negative strengths spread it. 1 moves it by 5 % of the
/// smallest radius per quarter radius.
ARGIL_ACTION(pinch, local, .is_signed = true, .curves = Curves::gentle, .place = 90, .key = 'P',
             .title = "Pinch", .help = "draws matter together; Ctrl spreads it",
             .picture = {.before = {.bump = 0.26F, .left = 0.95F, .right = 0.95F},
                         .after = {.tip = 0.62F, .tip_reach = 0.62F},
                         .hand = HandMark::together})

/// The surface sinks by a V along the stroke, once, however often it passes; negative strengths
/// raise a ridge. 1 is a quarter of the smallest radius in the middle.
ARGIL_ACTION(
    crease, profiled, .is_signed = true, .place = 100, .key = 'E', .title = "Crease",
    .help = "a sharp valley; Ctrl a sharp ridge",
    .picture = {
        .after = {.bump = 0.12F, .left = 0.9F, .right = 0.9F, .tip = -0.58F, .tip_reach = 0.42F}})

/// Matter moves with the tool. The strength is the fraction of the tool's path that the matter in
/// its middle follows.
ARGIL_ACTION(grab, anchored, .is_dragged = true, .curves = Curves::gentle, .place = 50, .key = 'G',
             .title = "Grab", .help = "moves matter with the hand",
             .picture = {.before = {.bump = 0.22F, .middle = -0.25F, .left = 0.6F, .right = 0.6F},
                         .after = {.bump = 0.62F, .middle = 0.08F, .left = 0.95F, .right = 0.45F},
                         .hand = HandMark::drag})

/// Matter turns about the tool's z axis; negative strengths turn the other way. 1 turns the middle
/// by a quarter radian per quarter radius.
ARGIL_ACTION(twist, anchored, .is_signed = true, .curves = Curves::gentle, .place = 110, .key = 'T',
             .title = "Twist", .help = "turns matter about the normal; Ctrl the other way",
             .picture = {.hand = HandMark::turn})

/// Masks matter: no action moves what is masked; negative strengths unmask it. 1 masks the middle
/// whole in a quarter radius.
ARGIL_ACTION(mask, painted, .is_signed = true, .curves = Curves::all, .place = 120, .key = 'M',
             .title = "Mask", .help = "holds matter so that nothing moves it; Ctrl lets it go",
             .picture = {.before = {.bump = 0.38F, .left = 0.9F, .right = 0.9F},
                         .after = {.bump = 0.38F, .left = 0.9F, .right = 0.9F},
                         .is_masked = true})

/// Raises the surface to a fixed height over where it was when the stroke began, however often the
/// stroke passes; negative strengths lower it. 1 is a quarter of the smallest radius in the middle.
ARGIL_ACTION(layer, anchored, .is_signed = true, .curves = Curves::all, .place = 15, .key = 'H',
             .title = "Layer",
             .help = "raises the surface once, however often a stroke passes; Ctrl lowers it",
             .picture = {.after = {.bump = 0.9F, .left = 0.8F, .right = 0.8F, .ceiling = 0.3F},
                         .hand = HandMark::across})

/// The profile of crease raised; negative strengths sink it. The strength as of crease.
ARGIL_ACTION(
    ridge, profiled, .is_signed = true, .place = 105, .key = 'I', .title = "Ridge",
    .help = "a sharp ridge; Ctrl a sharp valley",
    .picture = {
        .after = {.bump = -0.12F, .left = 0.9F, .right = 0.9F, .tip = 0.58F, .tip_reach = 0.42F}})

/// Fills up to a plane 1/16 of the smallest radius above the one that fits the surface under the
/// tool; what stands above it stays. Negative strengths dig as far below. The strength as of
/// smooth.
ARGIL_ACTION(clay, local, .is_signed = true, .curves = Curves::all, .place = 12, .key = 'J',
             .title = "Clay", .help = "lays clay on and levels it; Ctrl digs",
             .picture = {.before = {.wave = 0.20F},
                         .after = {.wave = 0.20F, .bump = 0.12F, .floor = 0.26F},
                         .hand = HandMark::pour})

/// The same by 1/32, with a square tip that lies along the stroke.
ARGIL_ACTION(clay_strips, local, .is_signed = true, .place = 13, .key = 'U', .title = "Strips",
             .help = "lays clay on in strips with a square tip; Ctrl digs them",
             .picture = {.after = {.floor = 0.3F}, .hand = HandMark::across})

/// Matter moves with the tool as in an elastic body that is pulled at one place: up to
/// three radii around, and it may keep its volume. The strength as of grab.
ARGIL_ACTION(elastic, anchored, .is_dragged = true, .place = 52, .key = kNoKey, .title = "Elastic",
             .help = "moves matter as rubber, which keeps its volume",
             .picture = {.before = {.bump = 0.22F, .middle = -0.1F, .left = 0.6F, .right = 0.6F},
                         .after = {.bump = 0.78F, .left = 1.0F, .right = 1.0F, .tip = -0.1F},
                         .hand = HandMark::drag})

/// Draws a tail of matter along with the tool. The strength is the fraction of the tool's path that
/// the matter in its middle follows.
ARGIL_ACTION(snake_hook, local, .is_dragged = true, .curves = Curves::gentle, .place = 54,
             .key = 'O', .title = "Hook", .help = "draws a tail out of the clay",
             .picture = {.after = {.bump = 0.8F, .middle = 0.3F, .left = 0.75F, .right = 0.22F},
                         .hand = HandMark::drag})

/// Moves detail along the surface and leaves the form as it is. The strength as of grab.
ARGIL_ACTION(slide, anchored, .curves = Curves::gentle, .place = 56, .key = kNoKey,
             .title = "Slide", .help = "moves detail along the surface, the form stays",
             .picture = {.before = {.bump = 0.4F, .middle = -0.3F, .left = 0.3F, .right = 0.3F},
                         .after = {.bump = 0.4F, .middle = 0.3F, .left = 0.3F, .right = 0.3F},
                         .hand = HandMark::across})

/// Cuts off what the tool reaches above the plane that fits the surface where the stroke begins.
/// The shape is shrunk as that of add.
ARGIL_ACTION(trim, anchored, .place = 75, .key = 'Q', .title = "Trim",
             .help = "cuts flat what stands above the plane where the stroke began",
             .picture = {.before = {.bump = 0.62F, .left = 0.9F, .right = 0.9F},
                         .after = {.bump = 0.62F, .left = 0.9F, .right = 0.9F, .ceiling = 0.2F},
                         .hand = HandMark::blade})

/// Roughens the surface by a noise of one wavelength, once, however often the stroke passes. 1
/// moves it by up to about a quarter of the smallest radius; negative strengths exchange heights
/// and hollows.
ARGIL_ACTION(noise, anchored, .is_signed = true, .curves = Curves::all, .place = 95, .key = 'N',
             .title = "Noise", .help = "roughens the surface; Ctrl exchanges heights and hollows",
             .picture = {.after = {.wave = 0.24F}, .hand = HandMark::circle})

/// Raises the surface by the grey of an image, once, however often dabs lie over each other;
/// negative strengths sink it. 1 is the tool's amplitude_mm from black to white.
ARGIL_ACTION(emboss, anchored, .is_signed = true, .place = 97, .key = kNoKey, .title = "Emboss",
             .help = "raises the surface by a grey image; Ctrl sinks it",
             .picture = {.after = {.print = 0.2F}, .hand = HandMark::press})

#undef ARGIL_ACTION
