// The page of a study: kind "study". The data are those of analysis/study/dipper_study/report.py.
import { foot, showPage } from '../page.js';
import { comparisons } from '../sections/study/comparisons.js';
import { curves, trends } from '../sections/study/curves.js';
import { failures, head, warnings } from '../sections/study/head.js';
import { optimum } from '../sections/study/optimum.js';
import { points, runs } from '../sections/study/tables.js';

showPage((data) => {
  window.dipper = { data }; // for the console, and for tests
  return [head(data), failures(data), warnings(data), optimum(data), curves(data), trends(data), comparisons(data), points(data), runs(data), foot()];
});
