"use strict";
// Placeholder: unpacks the data.
const data = JSON.parse(document.getElementById("report").textContent);
document.documentElement.dataset.runs = data.runs.length;
