// The page of a gap analysis: kind "gap". The data are those of analysis/gap/dipper_gap/report.py; a gap.json alone,
// as "answer", gives a page with what it holds.
import { foot, showPage } from '../page.js';
import { apart } from '../sections/gap/apart.js';
import { beforeAfter } from '../sections/gap/before_after.js';
import { face } from '../sections/gap/face.js';
import { heatMap } from '../sections/gap/heat_map.js';
import { history } from '../sections/gap/history.js';
import { again, experiments, rejected } from '../sections/gap/next.js';
import { ranking } from '../sections/gap/ranking.js';
import { head, verdict } from '../sections/gap/verdict.js';

showPage((data) => {
  window.dipper = { data }; // for the console, and for tests
  return [head(data), verdict(data), history(data), face(data), heatMap(data), ranking(data), beforeAfter(data),
    experiments(data), apart(data), rejected(data), again(data), foot()];
});
