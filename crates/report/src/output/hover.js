// What the mark nearest to the pointer says stands beside it; a tap on a phone shows it, too.
(() => {
  const NEAR = 24; // pixels
  const bubble = document.createElement("div");
  bubble.className = "bubble";
  bubble.hidden = true;
  document.body.append(bubble);
  let shown = null;
  const hide = () => {
    bubble.hidden = true;
    if (shown) shown.classList.remove("near");
    shown = null;
  };
  const show = (part, words, event) => {
    if (shown !== part) {
      hide();
      shown = part;
      part.classList.add("near");
      bubble.textContent = words;
      bubble.hidden = false;
    }
    const { width, height } = bubble.getBoundingClientRect();
    const right = document.documentElement.clientWidth - 8;
    const x = event.clientX + 16 + width > right ? event.clientX - 16 - width : event.clientX + 16;
    const y = event.clientY - height - 12 < 8 ? event.clientY + 20 : event.clientY - height - 12;
    bubble.style.left = `${Math.max(8, Math.min(x, right - width))}px`;
    bubble.style.top = `${y}px`;
  };
  document.querySelectorAll("svg.drawing").forEach((svg) => {
    // The browser's own, slow bubbles would come on top of these.
    const words = new Map();
    svg.querySelectorAll("title").forEach((title) => {
      const part = title.parentElement;
      words.set(part, title.textContent);
      part.setAttribute("aria-label", title.textContent);
      title.remove();
    });
    let marks = null;
    const measure = () => [...words.keys()]
      .filter((part) => part.tagName !== "polyline")
      .map((part) => ({ part, box: part.getBBox() }));
    const look = (event) => {
      const matrix = svg.getScreenCTM();
      if (!matrix) return;
      marks ??= measure();
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
      let nearest = null, least = (NEAR / matrix.a) ** 2;
      for (const { part, box } of marks) {
        const dx = Math.max(box.x - at.x, 0, at.x - box.x - box.width);
        const dy = Math.max(box.y - at.y, 0, at.y - box.y - box.height);
        const inside = dx === 0 && dy === 0;
        const cx = at.x - box.x - box.width / 2, cy = at.y - box.y - box.height / 2;
        // Within several boxes the nearest centre counts.
        const distance = inside ? 1e-9 * (cx * cx + cy * cy) : dx * dx + dy * dy;
        if (distance < least) [nearest, least] = [part, distance];
      }
      if (!nearest && words.has(event.target)) nearest = event.target;
      if (nearest) show(nearest, words.get(nearest), event);
      else hide();
    };
    svg.addEventListener("pointermove", look);
    svg.addEventListener("pointerdown", look);
    svg.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") hide(); });
  });
  addEventListener("scroll", hide, { passive: true });
})();
