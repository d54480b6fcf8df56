// A small observatory on a plain, at night, in metres: seen by the camera of a lensplane shot.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
#include "lensplane.inc"
camera { lensplane_camera }

light_source { <-400, 500, -300> rgb <1.0, 0.86, 0.7> * 1.4 }
light_source { <300, 200, 500> rgb <0.25, 0.35, 0.6> shadowless }
sky_sphere {
  pigment { gradient y color_map { [0.0 rgb <0.20, 0.13, 0.12>] [0.25 rgb <0.05, 0.06, 0.12>] [1.0 rgb 0.01] } }
}

// The ground: slabs of stone.
plane { y, 0
  pigment { checker rgb 0.35 rgb <0.22, 0.21, 0.24> scale 6 translate <3, 0.5, 0> }
  normal { bumps 0.15 scale 0.4 }
  finish { diffuse 0.8 specular 0.1 roughness 0.05 }
}

#declare Dome = union {
  cylinder { <0, 0, 0>, <0, 5, 0>, 6 pigment { rgb <0.75, 0.72, 0.66> } finish { diffuse 0.8 } }
  difference {
    sphere { <0, 5, 0>, 6 }
    box { <-1.1, 5, -7>, <1.1, 12, 0> }
    pigment { rgb <0.8, 0.82, 0.85> } finish { diffuse 0.5 specular 0.6 roughness 0.02 reflection 0.15 }
  }
  torus { 6, 0.25 translate 5 * y pigment { rgb <0.6, 0.3, 0.12> } finish { diffuse 0.6 specular 0.4 } }
}
object { Dome translate <0, 0, 120> }
object { Dome scale 0.6 rotate 70 * y translate <-22, 0, 105> }
object { Dome scale 0.5 rotate -50 * y translate <20, 0, 98> }

// Masts along the way, for straight lines that masses bend.
#for (I, -4, 4)
  cylinder { <I * 9, 0, 140>, <I * 9, 14, 140>, 0.25 pigment { rgb <0.7, 0.25, 0.15> } finish { diffuse 0.8 } }
  sphere { <I * 9, 14.4, 140>, 0.5 pigment { rgb <1, 0.8, 0.4> } finish { emission 1.5 diffuse 0 } }
#end

// A mirror ball that turns with time, so that frames differ.
sphere { <0, 3, 0>, 3
  pigment { rgb 0.1 } finish { diffuse 0.1 reflection 0.85 specular 0.5 roughness 0.005 }
  translate <-8, 0, 88> rotate 4 * sin(2 * pi * lensplane_time / 2) * y
}
