"""From a point cloud in a mine's coordinates to the surface or section that `pile.profile` takes. See docs/survey.md."""
