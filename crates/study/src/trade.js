// A stepper under the pointer stands out in every chart and table.
const steppers = document.querySelectorAll("[data-stepper]");
const light = (number) => {
  document.querySelectorAll("svg").forEach((svg) => svg.classList.toggle("lit", number !== null));
  steppers.forEach((part) => part.classList.toggle("on", part.dataset.stepper === number));
};
steppers.forEach((part) => {
  part.addEventListener("pointerenter", () => light(part.dataset.stepper));
  part.addEventListener("pointerleave", () => light(null));
});
