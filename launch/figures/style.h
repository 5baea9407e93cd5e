#pragma once

/// How all figures look.
namespace fastball::launch {

/// Colours that are told apart also with colour-blind eyes (Okabe and Ito), as gnuplot strings:
/// joint 1, 2, 3, 4.
inline constexpr const char* kColours[] = {"'#0072B2'", "'#D55E00'", "'#009E73'", "'#CC79A7'"};
/// Point types that are told apart without colour: filled circle, square, triangle, diamond.
inline constexpr int kMarks[] = {7, 5, 9, 13};
inline constexpr const char* kGrey = "'#606060'";
inline constexpr const char* kYellow = "'#E69F00'";

/// First commands of every picture.
inline constexpr const char* kStyle = R"(set encoding utf8
set grid lc rgb '#e4e4e4'
set border lw 1 lc rgb '#404040'
set key opaque noautotitle samplen 2.5 spacing 1.15
)";

}  // namespace fastball::launch
