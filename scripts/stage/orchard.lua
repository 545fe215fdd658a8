local rows = {
  { year = 2018, apples = 52, pears = 38, plums = 12 },
  { year = 2019, apples = 61, pears = 35, plums = 17 },
  { year = 2020, apples = 58, pears = 47, plums = 15 },
  { year = 2021, apples = 66, pears = 44, plums = 26 },
  { year = 2022, apples = 49, pears = 51, plums = 31 },
  { year = 2023, apples = 72, pears = 55, plums = 29 } }
local shares = { { fruit = "Apples", tons = 72 }, { fruit = "Pears", tons = 55 },
  { fruit = "Plums", tons = 29 }, { fruit = "Figs", tons = 6 } }

return { rows = rows, shares = shares }
