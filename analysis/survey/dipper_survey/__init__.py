"""From a point cloud in a mine's coordinates to the surface or section of `pile.profile`. See docs/survey.md."""
