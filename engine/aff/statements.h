#pragma once
#include "engine/aff/builder.h"
#include "engine/aff/lexer.h"
#include "engine/aff/reader.h"
#include "engine/aff/source.h"

namespace firstray::inline v0 {

/// What the functions that read a statement's body work with.
struct Reading {
    Lexer& in;
    SceneBuilder& builder;
    const SceneFolder& folder;
    const ReadLimits& limits;
};

// Each reads the body of one kind of statement, whose letters have been read. Defaults and meanings are those of NFF
// and of BART's parser.

// statements_settings.cpp
void read_view(Reading& r);          // v
void read_background(Reading& r);    // b
void read_ambient(Reading& r);       // am
void read_times(Reading& r);         // a
void read_light(Reading& r);         // l
void read_named_light(Reading& r);   // la
void read_nff_material(Reading& r);  // f
void read_material(Reading& r);      // fm
void read_keyframes(Reading& r);     // k

// statements_geometry.cpp
void read_cone(Reading& r);                            // c
void read_sphere(Reading& r);                          // s
void read_polygon(Reading& r);                         // p
void read_polygon_with_normals(Reading& r);            // pp
void read_textured_triangle(Reading& r);               // tt
void read_textured_triangle_with_normals(Reading& r);  // ttp
void read_deforming_triangle(Reading& r);              // tpa
void read_mesh(Reading& r);                            // m

/// Translation * rotation * scale, as "xs" writes it: three factors, axis and angle, translation.
/// throws  SceneError for a zero factor, or a zero axis with an angle other than zero
Transform read_transform(Lexer& in);

}  // namespace firstray::inline v0
