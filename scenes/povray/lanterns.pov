// Lanterns on a spiral that drift away in the dark: a plate that any renderer could have made. It knows nothing of
// lensplane; scenes/external-plate.sh renders it.
#version 3.7;
global_settings { assumed_gamma 1.0 }

camera { location <0, 0, 0> direction z right x * 1.2 * image_width / image_height up y * 1.2 }
light_source { <-40, 60, -20> rgb <1.0, 0.9, 0.8> }
sky_sphere {
  pigment { bozo color_map { [0.3 rgb <0.004, 0.006, 0.015>] [0.7 rgb <0.05, 0.02, 0.07>] [1 rgb <0.15, 0.08, 0.1>] }
    turbulence 0.6 scale <0.5, 0.2, 0.5> }
}

#for (I, 0, 119)
  #local Turn = I * 137.508;
  sphere { <0.42 * sqrt(I + 1), 0, 0>, 0.17 + 0.1 * mod(I, 3)
    pigment { rgb <1.0, 0.45 + 0.4 * mod(I, 5) / 4, 0.15 + 0.6 * mod(I, 7) / 6> }
    finish { diffuse 0.5 emission 0.5 + 0.8 * mod(I, 2) specular 0.3 }
    rotate (Turn + 20 * clock) * z
    translate <0, 0, 10 + 0.02 * I>
  }
#end
