"""The paper's Table 1 and figures 1 to 10 from result files, as PNG, SVG and PDF."""
