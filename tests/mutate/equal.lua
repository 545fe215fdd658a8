-- Mutants that change no picture, and why: they are not run. Each is the file's list of
-- { the line as it stands, the change as ./run mutate tells it, the reason }.
return {
  ["src/sweep/active.c"] = {
    { "if (tile_row > active->tile_row + 1)", "`+` to `-`",
      "begins anew at every height, where walking on gives the same: it only takes longer" },
  },
}
